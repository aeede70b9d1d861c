//! Which primitive actions a kind of body can ever do, whatever stands around it.

use simworld_core::action::ActionSet;
use simworld_core::scene::EntityKind;

/// What a body of that kind can ever do.
pub(crate) fn abilities(kind: EntityKind) -> ActionSet {
    match kind {
        EntityKind::Dog => ActionSet::dog(),
        kind if kind.is_vehicle() => ActionSet::vehicle(),
        _ => ActionSet::humanoid(),
    }
}
