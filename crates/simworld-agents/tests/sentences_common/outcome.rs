//! What the world shows after a plan.
