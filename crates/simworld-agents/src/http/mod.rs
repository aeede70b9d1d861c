//! What clients of servers share (feature `http`): addresses, keys that are in no log, agents, and how long to leave a server
//! alone.

mod key;
#[cfg(feature = "https")]
mod tls;
mod transport;

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

pub(crate) use key::ApiKey;
use ureq::Agent;
use ureq::http::{HeaderMap, Uri};
use ureq::unversioned::resolver::DefaultResolver;
use ureq::unversioned::transport::{Connector, DefaultConnector};

use self::transport::KeyedConnector;
use crate::model::{ModelError, PlainKey};

/// How a server is reached.
#[derive(Clone, Copy)]
pub(crate) struct Connecting<'a> {
    /// The most time to find the host, and then until the connection stands, s.
    pub(crate) connect_timeout: f64,
    /// The most time from a request to the last byte of its answer, s.
    pub(crate) timeout: f64,
    /// Certificates that are trusted instead of Mozilla's.
    pub(crate) root_certificates: Option<&'a Path>,
}

/// The address of a server, if it is one that can be reached and holds no secret.
pub(crate) fn checked_url(base_url: &str) -> Result<Uri, ModelError> {
    let config = |reason: &str| Err(ModelError::Config(reason.to_owned()));
    let Ok(uri) = base_url.parse::<Uri>() else {
        return config("base_url is no address: write it as http://host:port/v1");
    };
    // What may hold a secret is not repeated.
    if uri.authority().is_some_and(|authority| authority.as_str().contains('@')) || uri.query().is_some() {
        return config("base_url holds a user or a query: put a key into an environment variable instead");
    }
    match uri.scheme_str() {
        Some("http") => Ok(uri),
        Some("https") if cfg!(feature = "https") => Ok(uri),
        Some("https") => config("base_url is https: build with the feature `https`"),
        _ => config("base_url begins neither with http:// nor with https://"),
    }
}

/// The key that a variable of the environment holds, if one is named.
pub(crate) fn key(variable: Option<&str>) -> Result<Option<Arc<ApiKey>>, ModelError> {
    let Some(variable) = variable else { return Ok(None) };
    match ApiKey::from_variable(variable) {
        Some(key) => Ok(Some(Arc::new(key))),
        None => Err(ModelError::NoKey { variable: variable.to_owned() }),
    }
}

/// Refuses to send a key in the open, unless that is said.
pub(crate) fn check_key_is_safe(uri: &Uri, plain_key: PlainKey) -> Result<(), ModelError> {
    let plain = uri.scheme_str() == Some("http");
    if plain && !is_loopback(uri) && plain_key == PlainKey::LoopbackOnly {
        return Err(ModelError::Config(format!(
            "a key would travel in the open to {uri}: use https, or set plain_key to allowed"
        )));
    }
    Ok(())
}

/// Whether an address is on this machine.
pub(crate) fn is_loopback(uri: &Uri) -> bool {
    let host = uri.host().unwrap_or_default();
    let host = host.strip_prefix('[').and_then(|host| host.strip_suffix(']')).unwrap_or(host);
    host.eq_ignore_ascii_case("localhost")
        || host.parse::<std::net::IpAddr>().is_ok_and(|address| address.is_loopback())
}

/// A client that follows no redirects, takes every status for an answer, and puts the key in behind every log.
pub(crate) fn agent(
    connecting: Connecting<'_>,
    uri: &Uri,
    key: Option<Arc<ApiKey>>,
) -> Result<Agent, ModelError> {
    let connect = Some(Duration::from_secs_f64(connecting.connect_timeout));
    let mut builder = Agent::config_builder()
        .http_status_as_error(false)
        .max_redirects(0)
        .timeout_resolve(connect)
        .timeout_connect(connect)
        .timeout_global(Some(Duration::from_secs_f64(connecting.timeout)))
        .user_agent(concat!("simworld/", env!("CARGO_PKG_VERSION")));
    if is_loopback(uri) {
        // a proxy of the environment reaches its own loopback, not ours
        builder = builder.proxy(None);
    }
    #[cfg(not(feature = "https"))]
    if connecting.root_certificates.is_some() {
        return Err(ModelError::Config(
            "root_certificates is for https: build with the feature `https`".into(),
        ));
    }
    #[cfg(feature = "https")]
    {
        builder = builder.tls_config(tls::config(connecting.root_certificates)?);
    }
    let connector = DefaultConnector::new().chain(KeyedConnector::new(key));
    Ok(Agent::with_parts(builder.build(), connector, DefaultResolver::default()))
}

/// Seconds, or a date: counted from the server's own `Date`, so that no clock of ours is asked.
pub(crate) fn retry_after(headers: &HeaderMap) -> Option<Duration> {
    let text = |name: &str| headers.get(name).and_then(|value| value.to_str().ok());
    let value = text("retry-after")?.trim();
    if let Ok(seconds) = value.parse::<f64>() {
        // some servers give decimals; a wait of years is none that anybody means
        return (0.0..=f64::from(u32::MAX)).contains(&seconds).then(|| Duration::from_secs_f64(seconds));
    }
    let until = httpdate::parse_http_date(value).ok()?;
    let now = httpdate::parse_http_date(text("date")?).ok()?;
    Some(until.duration_since(now).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(pairs: &[(&'static str, &'static str)]) -> HeaderMap {
        pairs.iter().map(|(name, value)| (name.parse().unwrap(), value.parse().unwrap())).collect()
    }

    #[test]
    fn retry_after_is_seconds_or_a_date() {
        let date = ("date", "Sun, 06 Nov 1994 08:49:37 GMT");
        for (value, wait) in [
            ("7", Some(7)),
            ("2.0", Some(2)),
            (" 0 ", Some(0)),
            ("Sun, 06 Nov 1994 08:50:37 GMT", Some(60)),
            ("Sun, 06 Nov 1994 08:40:00 GMT", Some(0)),
            ("-3", None),
            ("soon", None),
            ("nan", None),
            ("inf", None),
            ("99999999999999999999", None),
        ] {
            let found = retry_after(&headers(&[("retry-after", value), date]));
            assert_eq!(found, wait.map(Duration::from_secs), "{value}");
        }
        assert_eq!(retry_after(&headers(&[("retry-after", "Sun, 06 Nov 1994 08:50:37 GMT")])), None);
    }
}
