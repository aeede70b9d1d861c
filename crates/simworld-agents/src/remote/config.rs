//! Settings of a server, and what it allows its clients.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};

use serde::{Deserialize, Serialize};

use super::{CameraPlace, RemoteError, Token};

/// When the world steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Pace {
    /// Only when a client says so.
    #[default]
    Lockstep,
    /// By the clock on the wall, this many seconds of the world in a second; more slowly if it cannot keep up.
    RealTime(f64),
}

impl Pace {
    /// Checks the factor.
    ///
    /// # Errors
    /// It is not between 0.01 and 1000.
    pub fn validate(self) -> Result<(), RemoteError> {
        match self {
            Self::RealTime(value) if !(0.01..=1000.0).contains(&value) => {
                Err(RemoteError::Setting { field: "pace.real_time", value, allowed: "0.01 to 1000" })
            }
            Self::Lockstep | Self::RealTime(_) => Ok(()),
        }
    }
}

/// What clients may ask of a server. Who goes beyond is held back, refused, or dropped with a reason.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Limits {
    /// Clients at a time, 1 to 1024; each has two threads.
    pub clients: usize,
    /// Bytes of a request, 64 to 2^28.
    pub frame_bytes: usize,
    /// Requests a second of one client, 1 to 1e7; more wait in its own connection.
    pub requests_per_second: f64,
    /// Requests of one client that wait for the world, 1 to 65536; more wait in its own connection.
    pub queued_requests: usize,
    /// Bytes of replies that wait for one client, 2^16 to 2^32. Nothing more is done for it while half of them wait, and it is
    /// dropped if a reply does not fit any more.
    pub queued_bytes: usize,
    /// Time within which a client says who it is, 0.01 to 3600 s.
    pub hello_seconds: f64,
    /// Time from the first byte of a request to its last, 0.01 to 3600 s.
    pub frame_seconds: f64,
    /// Time within which 64 KiB of replies are taken, 0.01 to 3600 s.
    pub write_seconds: f64,
    /// Time without any request, 0.01 to 86400 s.
    pub idle_seconds: f64,
    /// Steps that one request may ask for, 1 to 1e9.
    pub steps: u32,
    /// Things that clients may bring into the world, all together, 1 to 1e7. Vehicles and walkers that they let the traffic send, ways
    /// on which they send vehicles, and closures are among them, for good: the traffic does not tell who asked for what.
    pub spawned: usize,
    /// Bytes that clients may leave in names, attributes and ways of what is there, all together, 1024 to 2^32. What they do is
    /// recorded besides, for as long as the server runs.
    pub kept_bytes: usize,
    /// Cameras, 1 to 10000.
    pub cameras: usize,
    /// Pixels of a picture, 1 to 2^26.
    pub pixels: u32,
    /// Entities in one answer or observation, 1 to 1e6.
    pub entities: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            clients: 16,
            frame_bytes: 1 << 20,
            requests_per_second: 50_000.0,
            queued_requests: 256,
            queued_bytes: 64 << 20,
            hello_seconds: 5.0,
            frame_seconds: 10.0,
            write_seconds: 5.0,
            idle_seconds: 3600.0,
            steps: 100_000,
            spawned: 100_000,
            kept_bytes: 64 << 20,
            cameras: 256,
            pixels: 1 << 22,
            entities: 10_000,
        }
    }
}

impl Limits {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), RemoteError> {
        let hour = (0.01, 3600.0, "0.01 to 3600 s");
        let checks = [
            ("limits.clients", self.clients as f64, (1.0, 1024.0, "1 to 1024")),
            ("limits.frame_bytes", self.frame_bytes as f64, (64.0, 268_435_456.0, "64 to 2^28 bytes")),
            ("limits.requests_per_second", self.requests_per_second, (1.0, 1e7, "1 to 1e7")),
            ("limits.queued_requests", self.queued_requests as f64, (1.0, 65_536.0, "1 to 65536")),
            (
                "limits.queued_bytes",
                self.queued_bytes as f64,
                (65_536.0, 4_294_967_296.0, "2^16 to 2^32 bytes"),
            ),
            ("limits.hello_seconds", self.hello_seconds, hour),
            ("limits.frame_seconds", self.frame_seconds, hour),
            ("limits.write_seconds", self.write_seconds, hour),
            ("limits.idle_seconds", self.idle_seconds, (0.01, 86_400.0, "0.01 to 86400 s")),
            ("limits.steps", f64::from(self.steps), (1.0, 1e9, "1 to 1e9")),
            ("limits.spawned", self.spawned as f64, (1.0, 1e7, "1 to 1e7")),
            ("limits.kept_bytes", self.kept_bytes as f64, (1024.0, 4_294_967_296.0, "1024 to 2^32 bytes")),
            ("limits.cameras", self.cameras as f64, (1.0, 10_000.0, "1 to 10000")),
            ("limits.pixels", f64::from(self.pixels), (1.0, 67_108_864.0, "1 to 2^26")),
            ("limits.entities", self.entities as f64, (1.0, 1e6, "1 to 1e6")),
        ];
        for (field, value, (low, high, allowed)) in checks {
            if !(low..=high).contains(&value) {
                return Err(RemoteError::Setting { field, value, allowed });
            }
        }
        Ok(())
    }
}

/// Settings of a [`Server`](super::Server).
#[derive(Clone, Debug)]
pub struct ServerConfig {
    /// What clients are told they are connected to.
    pub name: String,
    /// Where clients of `UnrealCV` are listened for; port 0 takes a free one.
    pub unrealcv: Option<SocketAddr>,
    /// Where clients of the typed protocol are listened for; port 0 takes a free one.
    pub typed: Option<SocketAddr>,
    /// What clients have to show. Without one, only the loopback interface may be listened on.
    pub token: Option<Token>,
    /// When the world steps, until a client says otherwise.
    pub pace: Pace,
    /// The first camera, which no entity wears.
    pub camera: CameraPlace,
    /// What clients may ask.
    pub limits: Limits,
}

impl Default for ServerConfig {
    /// `UnrealCV` on its port 9000 and the typed protocol on 9001, both of the loopback interface.
    fn default() -> Self {
        let local = |port| Some(SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), port));
        Self {
            name: "simworld".to_owned(),
            unrealcv: local(9000),
            typed: local(9001),
            token: None,
            pace: Pace::default(),
            camera: CameraPlace::default(),
            limits: Limits::default(),
        }
    }
}

impl ServerConfig {
    /// The default settings, on ports of the loopback interface that happen to be free.
    pub fn on_free_ports() -> Self {
        let free = Some(SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), 0));
        Self { unrealcv: free, typed: free, ..Self::default() }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// A field out of range, no address, or an address that others reach without a token.
    pub fn validate(&self) -> Result<(), RemoteError> {
        self.limits.validate()?;
        self.pace.validate()?;
        self.camera.validate(&self.limits)?;
        let mut addresses = self.unrealcv.iter().chain(&self.typed).peekable();
        if addresses.peek().is_none() {
            return Err(RemoteError::NoAddress);
        }
        match addresses.find(|address| !address.ip().is_loopback()) {
            Some(address) if self.token.is_none() => Err(RemoteError::Open { address: *address }),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nobody_is_let_in_from_outside_without_a_token() {
        let everywhere = Some(SocketAddr::new(IpAddr::V4(Ipv4Addr::UNSPECIFIED), 0));
        let open = ServerConfig { unrealcv: everywhere, ..ServerConfig::on_free_ports() };
        assert!(matches!(open.validate(), Err(RemoteError::Open { .. })));
        let token = Token::new("sixteen-bytes-or-more").ok();
        assert!(ServerConfig { token, ..open }.validate().is_ok());
        assert!(ServerConfig::default().validate().is_ok());
    }

    #[test]
    fn absurd_settings_are_named() {
        let idle = ServerConfig { unrealcv: None, typed: None, ..ServerConfig::default() };
        assert!(matches!(idle.validate(), Err(RemoteError::NoAddress)));
        let limits = Limits { frame_seconds: f64::NAN, ..Limits::default() };
        let error = ServerConfig { limits, ..ServerConfig::default() }.validate().unwrap_err();
        assert!(error.to_string().starts_with("limits.frame_seconds"), "{error}");
        assert!(Pace::RealTime(0.0).validate().is_err());
    }
}
