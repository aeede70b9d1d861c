//! Manifests of asset folders: any text is refused with its line, or every path of it stays within the folder.

use std::path::{Component, Path};

use simworld_agents::library::Manifest;

pub(crate) fn check(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    if let Ok(manifest) = Manifest::read(text, 1000) {
        for row in &manifest.assets {
            let Some(path) = &row.get_ref().model else { continue };
            assert!(
                Path::new(path).components().all(|part| matches!(part, Component::Normal(_))),
                "{path:?}"
            );
            assert!(!path.contains([':', '\\', '\0']), "{path:?}");
        }
    }
}
