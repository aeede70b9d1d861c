//! A model from a GLB file: what became of it on its way to an asset, a sheet of moments and a film of what it does. Without a file it
//! is a mill whose sails turn, which is written as one first.
//!
//! ```sh
//! cargo run --release --example model -- --out out/model
//! ```

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use simworld_agents::assets::{ImportConfig, Imported, Thing, export_glb, import_glb};
use simworld_examples::exit_code;
use simworld_examples::folder::make_folder;
use simworld_examples::model::{mill, show};
use simworld_render::RenderError;

/// Reads a GLB file as an asset, prints how it came about, and draws it in what it does.
#[derive(Parser)]
struct Arguments {
    /// A GLB file; without one a mill is made and written.
    file: Option<PathBuf>,
    /// What it is, in words: they say how large such things are, and what they weigh.
    #[arg(long, default_value = "a mill")]
    words: String,
    /// How high it is, m, where that is known.
    #[arg(long)]
    height: Option<f64>,
    /// What it does; its first clip unless you say so.
    #[arg(long)]
    clip: Option<String>,
    /// Directory for the pictures.
    #[arg(long, default_value = "out/model")]
    out: PathBuf,
}

fn main() -> ExitCode {
    exit_code(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn std::error::Error>> {
    make_folder(&arguments.out)?;
    let (path, height) = match &arguments.file {
        Some(path) => (path.clone(), arguments.height),
        None => (write_mill(&arguments.out)?, arguments.height.or(Some(9.6))),
    };
    let bytes =
        std::fs::read(&path).map_err(|error| format!("{} cannot be read: {error}", path.display()))?;
    let mut thing = Thing { name: "model".into(), words: arguments.words.clone(), ..Thing::default() };
    thing.size.height = height;
    let imported = import_glb(&bytes, &thing, &ImportConfig::default())?;
    println!("{}\n{}", path.display(), table(&imported));
    match show(&imported.asset, arguments.clip.as_deref(), &arguments.out) {
        Ok(shown) => {
            let what = shown.clip.map_or("stands still".to_owned(), |clip| format!("plays {clip:?}"));
            println!("it {what}, {:.1} s:", shown.seconds);
            shown.files.iter().for_each(|file| println!("  {}", file.display()));
            Ok(())
        }
        Err(simworld_examples::model::ShowError::Render(error @ RenderError::NoAdapter { .. })) => {
            println!("no pictures: {error}");
            Ok(())
        }
        Err(error) => Err(error.into()),
    }
}

fn write_mill(out: &Path) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let path = out.join("mill.glb");
    std::fs::write(&path, export_glb(&mill()?))?;
    Ok(path)
}

fn table(imported: &Imported) -> Table {
    let Imported { asset, report } = imported;
    let size = asset.collider.size();
    let (triangles, pictures) =
        asset.model.as_ref().map_or((0, 0), |model| (model.triangles.len(), model.images.len()));
    let rig = asset.model.as_ref().and_then(|model| model.rig.as_ref());
    let clips = rig.map_or_else(Vec::new, |rig| {
        rig.clips().iter().map(|clip| format!("{} ({:.1} s)", clip.name, clip.seconds())).collect()
    });
    let bones = rig.map_or(0, |rig| rig.desc().bones.len());
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header(["what", "is"]);
    table.add_row(["size, m", &format!("{:.2} x {:.2} x {:.2}", size.x, size.y, size.z)]);
    table.add_row(["metres in a unit of the file", &format!("{}", report.scale)]);
    table.add_row(["mass, kg", &asset.mass.map_or_else(|| "-".to_owned(), |mass| format!("{mass:.0}"))]);
    table.add_row(["volume, m³", &format!("{:.3}", report.volume)]);
    table.add_row(["triangles, pictures", &format!("{triangles}, {pictures}")]);
    table.add_row(["convex solids to be met", &report.hulls.to_string()]);
    table.add_row([
        "edges, open, tangled",
        &format!("{}, {}, {}", report.repair.edges, report.repair.open, report.repair.tangled),
    ]);
    table.add_row(["bones", &bones.to_string()]);
    let clips = if clips.is_empty() { "none: it stands still".to_owned() } else { clips.join(", ") };
    table.add_row(["clips", &clips]);
    table
}
