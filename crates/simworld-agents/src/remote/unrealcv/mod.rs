//! `UnrealCV`.
use super::Token;
use super::engine::{Outcome, Served};
use super::link::Link;
use super::reader::Greeting;
use simworld_core::event::Event;
use simworld_core::scene::Scene;
#[derive(Default)]
pub(super) struct Desk {}
impl Desk {
    pub(super) fn answer(&mut self, _served: &mut Served<'_>, payload: &[u8]) -> Outcome {
        Outcome::Reply(payload.to_vec())
    }
    pub(super) fn before_step(&mut self, _served: &mut Served<'_>) {}
    pub(super) fn after_step(&mut self, _scene: &dyn Scene, _events: &[Event]) {}
}
pub(super) fn greeting(name: &str) -> Vec<u8> {
    format!("connected to {name}").into_bytes()
}
pub(super) fn farewell(reason: &dyn std::fmt::Display) -> Vec<u8> {
    format!("error {reason}").into_bytes()
}
pub(super) fn greet(_: &[u8], _: Option<&Token>, _: &Link) -> Greeting {
    Greeting::Welcome
}
