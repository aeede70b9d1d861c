//! Headless renderer.
