//! Hand-written scenes: any text is refused with its line, or comes back from being written.

use simworld_agents::scenes::file::SceneFile;

pub(crate) fn check(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    match SceneFile::parse(text) {
        Ok(scene) => {
            let written = scene.to_toml().expect("what was read can be written");
            let again = SceneFile::parse(&written).expect("what was written can be read");
            // NaN is no number that equals itself, and is refused when the scene is loaded.
            assert!(again == scene || written.contains("nan"), "{written}");
        }
        Err(error) => assert!(error.to_string().starts_with("scene:"), "{error}"),
    }
}
