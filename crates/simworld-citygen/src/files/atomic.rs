//! Files that are either whole or absent: written beside their place, then moved there.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes a file through `fill` and moves it to `path` when it is complete; folders on the way are made. Whatever was
/// there stays until then, and stays for good if `fill` fails or the process ends.
///
/// ```
/// use std::io::Write;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("new/hello.txt");
/// simworld_citygen::files::atomic::write(&path, |file| writeln!(file, "hello"))?;
/// assert_eq!(std::fs::read_to_string(&path)?, "hello\n");
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// A folder or file that cannot be made, or what `fill` returned.
pub fn write<E: From<io::Error>>(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> Result<(), E>,
) -> Result<(), E> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let written = File::create(&part).map_err(E::from).and_then(|file| {
        let mut writer = BufWriter::with_capacity(1 << 18, file);
        fill(&mut writer)?;
        writer.flush()?;
        Ok(fs::rename(&part, path)?)
    });
    if written.is_err() {
        // It may never have come to be; the first error is the one to tell.
        let _ = fs::remove_file(&part);
    }
    written
}
