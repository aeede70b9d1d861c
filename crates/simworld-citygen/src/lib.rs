//! Procedural cities.
