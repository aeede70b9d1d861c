//! The report of a run is one page that needs nothing from elsewhere, whatever the couriers are called; it opens in a browser
//! without an error, its slider shows who was where, and it comes out light, dark and on paper.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use simworld_core::clock::Tick;
use simworld_examples::delivery::{OutputFolder, RunConfig, Track, Watch, play, read_track};
use simworld_examples::report::write_report;
use simworld_tests::small;
use tempfile::TempDir;

/// Names that would do harm in a page that trusts them.
const NAMES: [(&str, &str); 2] = [
    ("courier 0", r#"<script>document.title=\"harmed\"</script>"#),
    ("courier 1", "</script><img src=x onerror=document.title=1>"),
];

/// A run that was reported; its track names couriers as [`NAMES`] says.
struct Reported {
    folder: TempDir,
    page: PathBuf,
    html: String,
}

static REPORTED: LazyLock<Reported> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let config = RunConfig { seeds: 1, ..small(900) };
    play(&config, &OutputFolder::create(folder.path()).unwrap(), &Watch::silent()).unwrap();
    let track = folder.path().join("seed-3/track.jsonl");
    let mut text = std::fs::read_to_string(&track).unwrap();
    for (name, harmful) in NAMES {
        let name = format!("\"{name}\"");
        assert!(text.contains(&name), "{name} is tracked");
        text = text.replacen(&name, &format!("\"{harmful}\""), 1);
    }
    std::fs::write(&track, text).unwrap();
    let page = write_report(folder.path()).unwrap();
    let html = std::fs::read_to_string(&page).unwrap();
    Reported { folder, page, html }
});

impl Reported {
    fn track(&self) -> Track {
        read_track(&self.folder.path().join("seed-3/track.jsonl")).unwrap()
    }
}

#[test]
fn nothing_comes_from_elsewhere_and_names_stay_names() {
    let html = &REPORTED.html;
    for key in ["src=", "href=", "url(", "@import", "action="] {
        for (at, _) in html.match_indices(key) {
            let rest = html[at + key.len()..].trim_start_matches('"');
            let shown: String = html[at..].chars().take(60).collect();
            let harmless = rest.starts_with('#')
                || html[..at].ends_with("&lt;img ")
                || html[..at].ends_with("u003cimg ");
            assert!(harmless, "{shown}");
        }
    }
    let addresses: Vec<&str> =
        html.match_indices("http").map(|(at, _)| &html[at..html.len().min(at + 27)]).collect();
    let known = |address: &&&str| {
        !address.starts_with("http://www.w3.org/2000/svg")
            && !address.starts_with("http-equiv=Content-Security")
    };
    assert_eq!(addresses.iter().find(known), None);
    // The scripts are those of the page itself: its own, and the data of the film.
    assert_eq!(html.matches("<script").count(), 2);
    assert!(!html.contains("<img"));
    assert!(html.contains("&lt;script&gt;document.title"), "the name is there, as text");
}

#[test]
fn the_page_holds_what_a_reader_asks_for_and_is_the_same_again() {
    let html = &REPORTED.html;
    for id in ["findings", "metrics", "figures", "map", "replay", "timelines", "story", "settings", "runs"] {
        assert!(
            html.contains(&format!("<section id={id}>")) && html.contains(&format!("href=\"#{id}\"")),
            "{id}"
        );
    }
    for part in [
        "paper: GPT-4o",
        "class=\"heat presence\"",
        "class=\"sign won\"",
        "customers<td>escrow",
        "hash <code>",
    ] {
        assert!(html.contains(part), "{part}");
    }
    assert!(html.len() < 5_000_000, "{} bytes", html.len());
    write_report(REPORTED.folder.path()).unwrap();
    assert_eq!(&std::fs::read_to_string(&REPORTED.page).unwrap(), html);
}

#[test]
fn a_folder_without_a_run_has_no_report() {
    let folder = tempfile::tempdir().unwrap();
    let error = write_report(folder.path()).unwrap_err().to_string();
    assert!(error.contains("holds no run"), "{error}");
    std::fs::write(folder.path().join("config.toml"), "seeds = 1\n").unwrap();
    let error = write_report(folder.path()).unwrap_err().to_string();
    assert!(error.contains("report.json is not there"), "{error}");
}

#[test]
fn a_browser_shows_everybody_where_they_were() {
    let Some(browser) = browser() else { return };
    let track = REPORTED.track();
    for seconds in [0, 31, 90] {
        let shown = dom(&browser, &format!("t={seconds}"));
        let clock = format!(">{}:{:02} of 1:30<", seconds / 60, seconds % 60);
        assert!(shown.contains(&clock), "{clock}");
        assert!(shown.contains("<title>simworld: a delivery run</title>"), "no name did harm");
        let (_, spots) = track.samples.iter().find(|sample| sample.0 == Tick(seconds * 10)).unwrap();
        let places = places(&shown);
        assert_eq!(places.len(), spots.len());
        // The page has its own origin, so ways between couriers are compared.
        for (place, spot) in places.iter().zip(spots) {
            let drawn = (place.0 - places[0].0, places[0].1 - place.1);
            let was = ((spot.x - spots[0].x) as f64, (spot.y - spots[0].y) as f64);
            assert!((drawn.0 - was.0).abs() < 0.1 && (drawn.1 - was.1).abs() < 0.1, "{drawn:?} for {was:?}");
        }
    }
    // Half a sample later everybody is halfway.
    let (before, between, after) =
        (places(&dom(&browser, "t=30")), places(&dom(&browser, "t=30.5")), places(&dom(&browser, "t=31")));
    let moved = before.iter().zip(&after).any(|(a, b)| a != b);
    assert!(moved, "somebody walks");
    for (index, place) in between.iter().enumerate() {
        let middle = f64::midpoint(before[index].0, after[index].0);
        assert!((place.0 - middle).abs() < 0.11, "{place:?}");
    }
}

#[test]
fn a_browser_plays_the_film_and_tells_another_story() {
    let Some(browser) = browser() else { return };
    // A busy machine may draw no second frame in two seconds of the page's time, so it is given more of it.
    let time = |shown: &str| after(shown, "data-time=\"").parse::<f64>().unwrap();
    let mut films = [2000, 8000, 32_000].into_iter().map(|budget| dom_within(&browser, budget, "t=10&play"));
    let shown = films.find(|shown| time(shown) > 10.0).expect("the film moves on");
    let told = |dom: &str| -> Vec<String> {
        let articles = dom.split("<article class=\"story\"").skip(1);
        let open = articles.filter(|article| !article[..article.find('>').unwrap()].contains("hidden"));
        open.map(|article| after(article, "data-order=\"")).collect()
    };
    let first = told(&shown);
    assert_eq!(first.len(), 1, "one story is told");
    let other = if first[0] == "1" { "2" } else { "1" };
    assert_eq!(told(&dom(&browser, &format!("order={other}"))), [other]);
}

#[test]
fn it_comes_out_light_and_dark_and_on_paper() {
    let Some(browser) = browser() else { return };
    let corner = |scheme: u32| {
        let picture = REPORTED.folder.path().join(format!("scheme-{scheme}.png"));
        let shot = format!("--screenshot={}", picture.display());
        let scheme = format!("--blink-settings=preferredColorScheme={scheme}");
        open(&browser, &[&shot, "--window-size=900,700", &scheme], "");
        let reader = std::io::BufReader::new(std::fs::File::open(&picture).unwrap());
        let mut reader = png::Decoder::new(reader).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels[0]
    };
    assert!(corner(1) > 240, "light paper");
    assert!(corner(0) < 40, "dark paper");
    let paper = REPORTED.folder.path().join("page.pdf");
    open(&browser, &[&format!("--print-to-pdf={}", paper.display()), "--no-pdf-header-footer"], "");
    let bytes = std::fs::read(&paper).unwrap();
    assert!(bytes.starts_with(b"%PDF") && bytes.len() > 20_000, "{} bytes", bytes.len());
}

/// A browser, by `SIMWORLD_BROWSER` or on the path; without one the tests say so and are skipped, unless
/// `SIMWORLD_REQUIRE_BROWSER` is set.
fn browser() -> Option<PathBuf> {
    let names = ["chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"];
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let on_path = names.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    let named = std::env::var_os("SIMWORLD_BROWSER").map(PathBuf::from);
    let found = named.into_iter().chain(on_path).find(|path| path.is_file());
    if found.is_none() {
        assert!(
            std::env::var_os("SIMWORLD_REQUIRE_BROWSER").is_none(),
            "no browser: install chromium-headless-shell"
        );
        println!("skipped: no browser; Debian has chromium-headless-shell");
    }
    found
}

/// Opens the page without a network; every error of its scripts and every refused request is a failure.
fn open(browser: &Path, arguments: &[&str], fragment: &str) -> Output {
    open_within(browser, 2000, arguments, fragment)
}

/// The same, given so many milliseconds of the page's own time.
fn open_within(browser: &Path, budget: u32, arguments: &[&str], fragment: &str) -> Output {
    let profile = tempfile::tempdir().unwrap();
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"])
        .args(["--host-resolver-rules=MAP * ~NOTFOUND", "--enable-logging=stderr"])
        .arg(format!("--virtual-time-budget={budget}"))
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .args(arguments)
        .arg(format!("file://{}#{fragment}", REPORTED.page.display()))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(!said.contains("CONSOLE"), "{said}");
    output
}

fn dom(browser: &Path, fragment: &str) -> String {
    dom_within(browser, 2000, fragment)
}

fn dom_within(browser: &Path, budget: u32, fragment: &str) -> String {
    String::from_utf8(open_within(browser, budget, &["--dump-dom"], fragment).stdout).unwrap()
}

/// Where couriers stand on the stage.
fn places(dom: &str) -> Vec<(f64, f64)> {
    let couriers = dom.split("<g class=\"courier").skip(1);
    let place = |courier: &str| {
        let numbers = after(courier, "transform=\"translate(");
        let (x, y) = numbers.split_once(' ').unwrap();
        (x.parse().unwrap(), y.parse().unwrap())
    };
    couriers.map(place).collect()
}

/// What follows a text, up to the end of an attribute.
fn after(text: &str, key: &str) -> String {
    let rest = &text[text.find(key).unwrap() + key.len()..];
    rest[..rest.find(['"', ')']).unwrap()].to_owned()
}
