//! Looks on: a city with its traffic, or a recorded run, on film without a window, or in a window that one flies through.
//!
//! ```sh
//! cargo run --release --example view
//! cargo run --release --example view --features window -- --window
//! cargo run --release --example view --features mp4 -- --mp4 out/street.mp4
//! cargo run --release --example view -- --frames 100 --gif out/street.gif --follow car --show paths,ids
//! cargo run --release --example view -- --scene examples/assets/scenes/harbour.scene.toml --vehicles 6 --pedestrians 10
//! cargo run --release --example view -- --replay out/delivery-1 --frames 60 --png out/run
//! ```

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use simworld_core::scene::EntityKind;
use simworld_core::seed::Seed;
use simworld_examples::city::{Source, make};
use simworld_examples::folder::make_folder;
use simworld_examples::view::{Film, Going, Layer, Panes, Stage, Viewer};
use simworld_examples::{Outcome, exit_code};

const NO_WINDOW: &str =
    "--window needs the feature window: `cargo run --release --example view --features window -- --window`";
const NO_VIDEO: &str =
    "--mp4 needs the feature mp4: `cargo run --release --example view --features mp4 -- --mp4 FILE.mp4`";

/// Films a city with its traffic, or a recorded run, or shows it in a window: from over the street where most is going on, or from behind
/// somebody; in colour, depth, classes or instances, or all of them side by side, with lanes, waypoints, ways come and ids drawn over the
/// picture. In the window one flies with W A S D and the pointer, and clicks at what one wants to know; H shows all keys.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// A saved city, as `--example city` writes it; otherwise one is grown.
    #[arg(long, value_name = "FILE.simcity")]
    city: Option<PathBuf>,
    /// A scene that is written by hand, in place of a city; docs/scenes.md has every key.
    #[arg(long, value_name = "FILE.scene.toml", conflicts_with_all = ["city", "replay"])]
    scene: Option<PathBuf>,
    /// Plays the run again that `--example delivery` recorded in this folder; its first seed.
    #[arg(long, value_name = "DIR", conflicts_with = "city")]
    replay: Option<PathBuf>,
    /// Seed of the traffic, and of a grown city.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// Vehicles.
    #[arg(long, default_value_t = 120)]
    vehicles: u32,
    /// People on foot.
    #[arg(long, default_value_t = 200)]
    pedestrians: u32,
    /// Follows whoever of that kind has most others around it: car, bus, person ...
    #[arg(long, value_name = "KIND", value_parser = kind)]
    follow: Option<EntityKind>,
    /// Layers over the picture: lanes, waypoints, paths, ids.
    #[arg(long, value_name = "LAYERS", value_delimiter = ',')]
    show: Vec<Layer>,
    /// What a picture shows: color, depth, classes, instances, all.
    #[arg(long, default_value = "color")]
    panes: Panes,
    /// Pixels across.
    #[arg(long, default_value_t = 960)]
    width: u32,
    /// Pixels down.
    #[arg(long, default_value_t = 540)]
    height: u32,
    /// Pictures of the film [default: 60]; a window closes after so many.
    #[arg(long)]
    frames: Option<u32>,
    /// Simulated time from one picture to the next, s; rounded to whole steps.
    #[arg(long, default_value_t = 0.1)]
    every: f64,
    /// Skips that much of what would be seen, s.
    #[arg(long, default_value_t = 0.0)]
    skip: f64,
    /// Says what is on that pixel of the film's first picture: X,Y from the top left.
    #[arg(long, value_name = "X,Y", value_delimiter = ',')]
    ask: Vec<u32>,
    /// Films to a GIF [default: out/view.gif, unless another film is asked for].
    #[arg(long, value_name = "FILE.gif")]
    gif: Option<PathBuf>,
    /// Films to a folder of PNG files.
    #[arg(long, value_name = "DIR")]
    png: Option<PathBuf>,
    /// Films to a video, AV1 in MP4; needs the feature `mp4`.
    #[arg(long, value_name = "FILE.mp4")]
    mp4: Option<PathBuf>,
    /// Shows it in a window instead; needs the feature `window`. Pictures that are taken there lie in `out/view`.
    #[arg(long, conflicts_with_all = ["gif", "png", "mp4", "ask", "every"])]
    window: bool,
}

fn main() -> ExitCode {
    let mut arguments = Arguments::parse();
    if !arguments.window && arguments.gif.is_none() && arguments.png.is_none() && arguments.mp4.is_none() {
        arguments.gif = Some(PathBuf::from("out/view.gif"));
    }
    exit_code(job(&arguments))
}

fn job(arguments: &Arguments) -> Outcome<()> {
    check(arguments)?;
    let mut stage = if let Some(folder) = &arguments.replay {
        Stage::of_recording(folder)?
    } else if let Some(path) = &arguments.scene {
        Stage::of_scene(path, arguments.vehicles, arguments.pedestrians, Seed(arguments.seed))?
    } else {
        let city = make(&Source::saved_or_small(arguments.city.as_ref()), Seed(arguments.seed))?.city;
        Stage::of_city(&city, arguments.vehicles, arguments.pedestrians, Seed(arguments.seed))?
    };
    for _ in 0..(arguments.skip / stage.dt()).round() as u64 {
        if stage.step()? == Going::Ended {
            return Err(format!("--skip {} leaves nothing of the recorded run", arguments.skip).into());
        }
    }
    let follow = match arguments.follow {
        Some(kind) => Some(
            stage
                .liveliest(Some(kind))
                .ok_or_else(|| format!("--follow {kind}: nobody of that kind moves here"))?,
        ),
        None => stage.hero(),
    };
    let mut viewer = Viewer::new(stage, [arguments.width, arguments.height])?;
    viewer.outlook.panes = arguments.panes;
    viewer.outlook.layers = arguments.show.iter().copied().collect();
    viewer.follow(follow);
    if arguments.window { look_on(&mut viewer, arguments) } else { film(&mut viewer, arguments) }
}

/// Films, and says what was made.
fn film(viewer: &mut Viewer, arguments: &Arguments) -> Outcome<()> {
    let wanted = arguments.frames.unwrap_or(60);
    let taken = take(viewer, films(arguments)?, wanted, arguments)?;
    if taken < wanted {
        println!("the recorded run has come to its end");
    }
    println!("{taken} pictures, drawn on {}", viewer.adapter());
    for path in [&arguments.gif, &arguments.png, &arguments.mp4].into_iter().flatten() {
        println!("written to {}", path.display());
    }
    Ok(())
}

#[cfg(feature = "window")]
fn look_on(viewer: &mut Viewer, arguments: &Arguments) -> Outcome<()> {
    println!("drawn on {}; H shows the keys", viewer.adapter());
    let shown = simworld_examples::view::show(viewer, Path::new("out/view"), arguments.frames)?;
    println!("{} pictures of {} steps", shown.pictures, shown.steps);
    Ok(())
}

#[cfg(not(feature = "window"))]
fn look_on(_: &mut Viewer, _: &Arguments) -> Outcome<()> {
    Err(NO_WINDOW.into())
}

fn kind(name: &str) -> Result<EntityKind, String> {
    EntityKind::from_name(name).ok_or_else(|| "there is no such kind".to_owned())
}

fn check(arguments: &Arguments) -> Outcome<()> {
    if arguments.window && cfg!(not(feature = "window")) {
        return Err(NO_WINDOW.into());
    }
    if arguments.mp4.is_some() && cfg!(not(feature = "mp4")) {
        return Err(NO_VIDEO.into());
    }
    if !(0.01..=60.0).contains(&arguments.every) {
        return Err(format!("--every {}: give 0.01 to 60 s", arguments.every).into());
    }
    if !(0.0..=1e5).contains(&arguments.skip) {
        return Err(format!("--skip {}: give 0 to 100000 s", arguments.skip).into());
    }
    if arguments.frames == Some(0) {
        return Err("--frames 0: give at least one".into());
    }
    if !matches!(arguments.ask.len(), 0 | 2) {
        return Err("--ask: give X,Y".into());
    }
    if let [x, y] = arguments.ask[..]
        && (x >= arguments.width || y >= arguments.height)
    {
        let (width, height) = (arguments.width, arguments.height);
        return Err(format!("--ask {x},{y}: the picture has {width} x {height} pixels").into());
    }
    Ok(())
}

/// The films that are asked for.
fn films(arguments: &Arguments) -> Outcome<Vec<Film>> {
    let mut films = Vec::new();
    for path in [&arguments.gif, &arguments.mp4].into_iter().flatten() {
        make_folder(path.parent().unwrap_or(Path::new(".")))?;
    }
    if let Some(path) = &arguments.gif {
        films.push(Film::gif(path, arguments.every));
    }
    if let Some(folder) = &arguments.png {
        films.push(Film::pngs(folder)?);
    }
    if let Some(path) = &arguments.mp4 {
        films.push(video(path, arguments.every)?);
    }
    Ok(films)
}

#[cfg(feature = "mp4")]
#[expect(clippy::unnecessary_wraps, reason = "without the feature it fails")]
fn video(path: &Path, seconds: f64) -> Outcome<Film> {
    Ok(Film::mp4(path, seconds))
}

#[cfg(not(feature = "mp4"))]
fn video(_: &Path, _: f64) -> Outcome<Film> {
    Err(NO_VIDEO.into())
}

/// Takes the pictures, as many as are wanted or a recorded run has, and shows how far it has come; returns how many.
fn take(viewer: &mut Viewer, mut films: Vec<Film>, wanted: u32, arguments: &Arguments) -> Outcome<u32> {
    let steps = (arguments.every / viewer.stage.dt()).round().max(1.0) as u32;
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} pictures, {eta} left")?;
    let bar = ProgressBar::new(u64::from(wanted)).with_style(style);
    let mut taken = 0;
    let mut going = Going::On;
    while taken < wanted && going == Going::On {
        viewer.draw()?;
        if let ([x, y], 0) = (&arguments.ask[..], taken) {
            let card = viewer.pick([*x, *y]).unwrap_or_else(|| vec!["the sky".to_owned()]);
            println!("on ({x}, {y}): {}", card.join("\n  "));
        }
        for film in &mut films {
            film.take(viewer.canvas())?;
        }
        taken += 1;
        for _ in 0..steps {
            going = viewer.step()?;
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    for film in films {
        film.finish()?;
    }
    Ok(taken)
}
