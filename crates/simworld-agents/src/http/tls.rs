//! Whose certificates are trusted (feature `https`).

use std::path::Path;

use ureq::tls::{Certificate, PemItem, RootCerts, TlsConfig, parse_pem};

use crate::model::ModelError;

/// Mozilla's, or those of a file.
pub(crate) fn config(roots: Option<&Path>) -> Result<TlsConfig, ModelError> {
    let roots = match roots {
        None => RootCerts::WebPki,
        Some(path) => RootCerts::new_with_certs(&read(path)?),
    };
    Ok(TlsConfig::builder().root_certs(roots).build())
}

fn read(path: &Path) -> Result<Vec<Certificate<'static>>, ModelError> {
    let store = |reason: String| ModelError::Store { path: path.display().to_string(), reason };
    let pem = std::fs::read(path).map_err(|error| store(error.to_string()))?;
    let mut certificates = Vec::new();
    for item in parse_pem(&pem) {
        if let PemItem::Certificate(certificate) = item.map_err(|error| store(error.to_string()))? {
            certificates.push(certificate);
        }
    }
    if certificates.is_empty() {
        return Err(store("it holds no certificate: it must be a PEM file with BEGIN CERTIFICATE".into()));
    }
    Ok(certificates)
}
