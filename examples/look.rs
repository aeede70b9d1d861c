//! A city in the light of any hour and in any weather: a contact sheet, and each picture of it alone.
//!
//! ```sh
//! cargo run --release --example look
//! cargo run --release --example look -- --city city.simcity --weather rain --time 19:30
//! ```

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use simworld_citygen::{City, CityConfig};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::environment::{Environment, Moment, NamedTime, NamedWeather, Preset, day_of_year};
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_examples::look::{Sheet, crowd, map_around, scan, street};
use simworld_examples::{Outcome, exit_code, folder};
use simworld_render::classes::class_by_id;
use simworld_render::{AntiAliasing, Frame, RenderConfig, Renderer};
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// Draws a city in four weathers, at night, as colour, depth and classes, its densest crowd, and a place from above and as a scanner hears it.
///
/// Writes sheet.png with all of them and a file for each. A view of --weather, --time, --date and --latitude is among them.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// A saved city, as the example `city` writes it; without one a city is generated.
    #[arg(long, value_name = "FILE.simcity")]
    city: Option<PathBuf>,
    /// Seed of the generated city, of its traffic and of its people.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// Weather by its name, with or without a time of day: clear, rain, snow, fog, `CloudySunset`, `HardRainNight`, ...
    #[arg(long, value_name = "NAME", default_value = "wet")]
    weather: Preset,
    /// Time by the sun, such as 19:30; 12:00 is when it stands highest.
    #[arg(long, value_name = "HH:MM", value_parser = hour)]
    time: Option<f64>,
    /// The date, such as 2026-06-21.
    #[arg(long, value_name = "YYYY-MM-DD", value_parser = date, default_value = "2026-04-29")]
    date: (i32, u32),
    /// Degrees north of the equator, from -90 to 90.
    #[arg(long, value_name = "DEGREES", value_parser = degrees_north, default_value = "40", allow_negative_numbers = true)]
    latitude: f64,
    /// Pixels across one picture.
    #[arg(long, default_value_t = 448)]
    width: u32,
    /// The folder to write to.
    #[arg(long, value_name = "DIR", default_value = "out/look")]
    out: PathBuf,
}

fn degrees_north(text: &str) -> Result<f64, String> {
    let degrees = text.parse().ok().filter(|degrees: &f64| (-90.0..=90.0).contains(degrees));
    degrees.ok_or_else(|| format!("{text:?} is no latitude: give -90 to 90 degrees"))
}

fn hour(text: &str) -> Result<f64, String> {
    let wrong = || format!("{text:?} is no time of day: give hours and minutes, such as 19:30");
    let (hours, minutes) = text.split_once(':').ok_or_else(wrong)?;
    let (hours, minutes) =
        (hours.parse::<u8>().map_err(|_| wrong())?, minutes.parse::<u8>().map_err(|_| wrong())?);
    if hours > 23 || minutes > 59 {
        return Err(wrong());
    }
    Ok(f64::from(hours) + f64::from(minutes) / 60.0)
}

fn date(text: &str) -> Result<(i32, u32), String> {
    let wrong = || format!("{text:?} is no date: give year, month and day, such as 2026-06-21");
    let parts: Vec<u32> = text.split('-').map(str::parse).collect::<Result<_, _>>().map_err(|_| wrong())?;
    let [year, month, day] = parts[..] else { return Err(wrong()) };
    let year = i32::try_from(year).map_err(|_| wrong())?;
    Ok((year, day_of_year(year, month, day).ok_or_else(wrong)?))
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

/// The city with traffic and people that have been on their way for a minute.
fn populate(arguments: &Arguments) -> Outcome<(City, World)> {
    let seed = Seed(arguments.seed);
    let city = match &arguments.city {
        Some(path) => City::load(path).map_err(|error| {
            format!(
                "{} is no city that can be loaded: {error}; the example `city` writes one",
                path.display()
            )
        })?,
        None => City::generate(&CityConfig::with_roads(60), seed)?,
    };
    let mut world = World::new();
    city.populate(&mut world)?;
    let config = TrafficConfig { vehicles: 90, pedestrians: 400, ..TrafficConfig::default() };
    let mut traffic = TrafficDynamics::new(&mut world, &config, seed)?;
    for _ in 0..600 {
        traffic.step(&mut world, 0.1)?;
        world.finish_step();
    }
    Ok((city, world))
}

/// What was asked for: the weather by name, and the sun by time, date and place.
fn wished(arguments: &Arguments) -> Outcome<Environment> {
    let mut environment = arguments.weather.environment();
    if arguments.time.is_some() || arguments.weather.time.is_none() {
        let (year, day_of_year) = arguments.date;
        let latitude = arguments.latitude.to_radians();
        let hour = arguments.time.unwrap_or(16.0);
        environment.set_moment(&Moment { year, day_of_year, hour, latitude, ..Moment::default() })?;
    }
    Ok(environment)
}

fn preset(weather: NamedWeather, time: NamedTime) -> Environment {
    Preset { weather, time: Some(time) }.environment()
}

/// Draws into the sheet and into a file of its own.
struct Studio<'a> {
    renderer: Renderer,
    world: World,
    frame: Frame,
    sheet: Sheet,
    out: &'a Path,
}

impl Studio<'_> {
    fn draw(&mut self, name: &str, caption: &str, camera: &Camera, environment: Environment) -> Outcome<()> {
        self.world.set_environment(environment)?;
        self.renderer.render(&self.world, camera, &mut self.frame)?;
        self.frame.write_png(self.out.join(format!("{name}.png")))?;
        self.sheet.add(caption, &self.frame.rgb);
        Ok(())
    }
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let wish = wished(arguments)?;
    let (city, world) = populate(arguments)?;
    let height = (arguments.width * 9 / 16).max(1);
    let intrinsics = Intrinsics::from_fov(arguments.width, height, 1.2)?;
    let along =
        street(&world, &city.network, intrinsics).ok_or("the city has no street of 70 m to stand on")?;
    let before = crowd(&world, intrinsics).ok_or("there are no people in the city")?;
    folder::make_folder(&arguments.out)?;
    let config = RenderConfig { anti_aliasing: AntiAliasing::Msaa4, ..RenderConfig::default() };
    let sheet = Sheet::new(3, arguments.width as usize, height as usize);
    let renderer = Renderer::new(&config)?;
    let mut studio = Studio { renderer, world, frame: Frame::new(), sheet, out: &arguments.out };
    let weathers = [
        ("clear", "clear, noon", preset(NamedWeather::Clear, NamedTime::Noon)),
        ("rain", "rain, noon", preset(NamedWeather::HardRain, NamedTime::Noon)),
        ("fog", "fog, noon", preset(NamedWeather::Fog, NamedTime::Noon)),
        ("snow", "snow, noon", preset(NamedWeather::Snow, NamedTime::Noon)),
        ("sunset", "cloudy, sunset", preset(NamedWeather::Cloudy, NamedTime::Sunset)),
        ("night", "wet, night", preset(NamedWeather::Wet, NamedTime::Night)),
    ];
    for (name, caption, environment) in weathers {
        studio.draw(name, caption, &along, environment)?;
    }
    studio.draw("crowd", "a crowd", &before, preset(NamedWeather::Clear, NamedTime::Noon))?;
    let asked = format!("as asked: {}", arguments.weather);
    studio.draw("asked", &asked, &along, wish)?;
    measures(&mut studio)?;
    from_above(&mut studio, &along)?;
    let (across, down, bytes) = studio.sheet.draw();
    let path = arguments.out.join("sheet.png");
    write_png(&path, [across, down], &bytes)?;
    println!("drawn on {}; the sheet is {}", studio.renderer.adapter(), path.display());
    Ok(())
}

/// Depth and classes of the last picture.
fn measures(studio: &mut Studio<'_>) -> Outcome<()> {
    let frame = &studio.frame;
    std::fs::write(studio.out.join("depth.png"), frame.depth_png()?)?;
    std::fs::write(studio.out.join("classes.png"), frame.classes_png()?)?;
    // Near is bright; the eye tells shares apart, not differences.
    let grey = |depth: &f32| if depth.is_finite() { (255.0 / (1.0 + depth / 12.0)) as u8 } else { 0 };
    let depth: Vec<u8> = frame.depth.iter().flat_map(|depth| [grey(depth); 3]).collect();
    let classes: Vec<u8> =
        frame.classes.iter().flat_map(|id| class_by_id(*id).map_or([0; 3], |class| class.color)).collect();
    studio.sheet.add("its depth", &depth);
    studio.sheet.add("its classes", &classes);
    Ok(())
}

/// The place from above at noon, and what a scanner on a car hears of it.
fn from_above(studio: &mut Studio<'_>, along: &Camera) -> Outcome<()> {
    let Some((map, car)) = map_around(&studio.world, along) else { return Ok(()) };
    studio.world.set_environment(preset(NamedWeather::Clear, NamedTime::Noon))?;
    map.draw(&mut studio.renderer, &studio.world, &mut studio.frame)?;
    studio.frame.write_png(studio.out.join("map.png"))?;
    studio.sheet.add("from above", &studio.frame.rgb);
    let echoes = scan(&studio.world, &map, car)?;
    let size = [map.width as usize, map.height as usize];
    write_png(&studio.out.join("scan.png"), size, &echoes)?;
    studio.sheet.add("a scan, by class", &echoes);
    Ok(())
}

fn write_png(path: &Path, [width, height]: [usize; 2], rgb: &[u8]) -> Outcome<()> {
    let file = std::io::BufWriter::new(std::fs::File::create(path)?);
    let mut encoder = png::Encoder::new(file, u32::try_from(width)?, u32::try_from(height)?);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(rgb)?;
    Ok(())
}
