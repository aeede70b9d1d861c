//! Microscopic traffic.
