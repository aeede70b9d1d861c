//! Physics and embodiments.
