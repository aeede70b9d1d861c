//! What somebody else drives: vehicles that are [taken over](controls), how they [come back](join) among the others, and bodies
//! that never were [of the traffic](strangers).

pub(super) mod controls;
pub(super) mod join;
pub(super) mod strangers;
