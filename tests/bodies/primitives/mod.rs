//! What bodies do: everybody who can sit finds the nearest chair from anywhere, and every primitive action is carried out by
//! bodies under physics, seen by others, and refused with its reason where it is impossible.

mod actions;
mod moving;
mod people;
mod sitting;
mod stage;
mod things;
mod town;
mod vehicles;
