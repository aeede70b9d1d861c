//! Over TLS the key reaches a server that is trusted, and no other.
#![cfg(feature = "https")]

use std::io::{Read, Write};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Arc, mpsc};

use rustls::pki_types::PrivateKeyDer;
use rustls::{ServerConfig, ServerConnection, StreamOwned};
use simworld_agents::model::*;

const VARIABLE: &str = "SIMWORLD_TEST_TLS_KEY";
const KEY: &str = "sk-over-tls-0123456789";

/// A server with a certificate that it signed itself; it answers each request with the same words.
struct TlsServer {
    config: OpenAiConfig,
    certificate: PathBuf,
    heads: mpsc::Receiver<String>,
}

impl TlsServer {
    fn start(folder: &Path) -> Self {
        let made = rcgen::generate_simple_self_signed(["localhost".to_owned()]).unwrap();
        let certificate = folder.join("certificate.pem");
        std::fs::write(&certificate, made.cert.pem()).unwrap();
        let key = PrivateKeyDer::try_from(made.signing_key.serialize_der()).unwrap();
        let tls = ServerConfig::builder_with_provider(Arc::new(rustls::crypto::ring::default_provider()))
            .with_safe_default_protocol_versions()
            .unwrap()
            .with_no_client_auth()
            .with_single_cert(vec![made.cert.der().clone()], key)
            .unwrap();
        let tls = Arc::new(tls);
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = listener.local_addr().unwrap().port();
        let (sender, heads) = mpsc::channel();
        std::thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let mut stream = StreamOwned::new(ServerConnection::new(tls.clone()).unwrap(), stream);
                if let Some(head) = answer(&mut stream) {
                    let _ = sender.send(head);
                }
            }
        });
        let base_url = format!("https://localhost:{port}/v1");
        let config = OpenAiConfig {
            base_url,
            key_variable: Some(VARIABLE.into()),
            timeout: 10.0,
            ..OpenAiConfig::default()
        };
        Self { config, certificate, heads }
    }
}

/// Reads a request whole, and answers it; the head of the request, if a client came so far.
fn answer(stream: &mut (impl Read + Write)) -> Option<String> {
    let mut bytes = Vec::new();
    let mut buffer = [0; 4096];
    let (head, length) = loop {
        let count = stream.read(&mut buffer).ok().filter(|count| *count > 0)?;
        bytes.extend_from_slice(&buffer[..count]);
        let text = String::from_utf8_lossy(&bytes);
        if let Some((head, _)) = text.split_once("\r\n\r\n") {
            let length = head
                .lines()
                .find_map(|line| line.to_lowercase().strip_prefix("content-length: ")?.parse().ok());
            break (head.to_owned(), head.len() + 4 + length.unwrap_or(0usize));
        }
    };
    while bytes.len() < length {
        let count = stream.read(&mut buffer).ok().filter(|count| *count > 0)?;
        bytes.extend_from_slice(&buffer[..count]);
    }
    let body = r#"{"choices": [{"message": {"content": "safe"}, "finish_reason": "stop"}]}"#;
    write!(stream, "HTTP/1.1 200 OK\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{body}", body.len())
        .ok()?;
    stream.flush().ok()?;
    Some(head)
}

#[test]
fn the_key_reaches_a_trusted_server_and_no_other() {
    if std::env::var_os(VARIABLE).is_none() {
        let output = Command::new(std::env::current_exe().unwrap())
            .args([
                "models_speak_over_tls::the_key_reaches_a_trusted_server_and_no_other",
                "--exact",
                "--nocapture",
            ])
            .env(VARIABLE, KEY)
            .output()
            .unwrap();
        let told = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && told.contains("1 passed"), "{told}");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let server = TlsServer::start(folder.path());
    let request = ChatRequest::new([Message::user("?")]);

    // nobody that Mozilla trusts has signed it
    let stranger = OpenAiChat::new(server.config.clone()).unwrap().chat(&request);
    assert!(matches!(stranger, Err(ModelError::Transport { .. })), "{stranger:?}");
    assert!(server.heads.try_recv().is_err(), "nothing was sent");

    let trusting =
        OpenAiConfig { root_certificates: Some(server.certificate.clone()), ..server.config.clone() };
    let mut model = OpenAiChat::new(trusting.clone()).unwrap();
    for _ in 0..2 {
        assert_eq!(model.chat(&request).unwrap().text, "safe");
        let head = server.heads.recv().unwrap();
        assert!(head.contains(&format!("authorization: Bearer {KEY}")), "{head}");
    }

    // trusted, but under another name
    let elsewhere =
        OpenAiConfig { base_url: trusting.base_url.replace("localhost", "127.0.0.1"), ..trusting };
    let answer = OpenAiChat::new(elsewhere).unwrap().chat(&request);
    assert!(matches!(answer, Err(ModelError::Transport { .. })), "{answer:?}");
    assert!(server.heads.try_recv().is_err(), "nothing was sent");
}

#[test]
fn a_server_without_tls_is_a_typed_error() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let base_url = format!("https://{}/v1", listener.local_addr().unwrap());
    std::thread::spawn(move || {
        for mut stream in listener.incoming().flatten() {
            let _ = stream.write_all(b"HTTP/1.1 400 Bad Request\r\n\r\n");
        }
    });
    let config = OpenAiConfig { base_url, timeout: 5.0, ..OpenAiConfig::default() };
    let answer = OpenAiChat::new(config).unwrap().chat(&ChatRequest::new([Message::user("?")]));
    assert!(matches!(answer, Err(ModelError::Transport { .. })), "{answer:?}");
}

#[test]
fn files_of_certificates_that_hold_none_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("roots.pem");
    let config = OpenAiConfig { root_certificates: Some(path.clone()), ..OpenAiConfig::default() };
    let missing = OpenAiChat::new(config.clone()).unwrap_err();
    std::fs::write(&path, "no certificate").unwrap();
    for error in [missing, OpenAiChat::new(config).unwrap_err()] {
        assert!(
            matches!(&error, ModelError::Store { path: named, .. } if named.contains("roots.pem")),
            "{error}"
        );
    }
}
