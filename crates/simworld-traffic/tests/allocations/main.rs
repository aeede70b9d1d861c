//! What asks the heap for nothing, counted by an allocator of its own.

mod counting;
mod crowds_allocate_nothing;
mod steps_allocate_nothing;
