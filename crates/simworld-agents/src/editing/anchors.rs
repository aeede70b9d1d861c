//! The things that a place names: who looks at them and who puts others in their stead go by the same list.

use simworld_core::id::EntityId;

use super::edit::{Line, Stand};

/// What a stand names, by reference or by mutable reference as the stand is given.
macro_rules! of_stand {
    ($stand:expr) => {
        match $stand {
            Stand::To { anchor, .. }
            | Stand::AcrossFrom { anchor }
            | Stand::Along { anchor }
            | Stand::AtCornerOf { anchor }
            | Stand::Towards { anchor, .. }
            | Stand::Offset { anchor, .. }
            | Stand::Apart { anchor, .. }
            | Stand::OnBlockOf { anchor }
            | Stand::InMiddleOf { anchor }
            | Stand::AtEdgeOf { anchor } => [Some(anchor), None],
            Stand::Between { one, other } => [Some(one), Some(other)],
            Stand::AlongRoad { .. }
            | Stand::OnSide { .. }
            | Stand::AtJunction { .. }
            | Stand::At { .. }
            | Stand::Around { .. } => [None, None],
        }
    };
}

/// The same for a line.
macro_rules! of_line {
    ($line:expr) => {
        match $line {
            Line::Along { anchor } | Line::Around { anchor } => [Some(anchor), None],
            Line::Between { one, other } => [Some(one), Some(other)],
            Line::Road { .. } | Line::RoadSide { .. } => [None, None],
        }
    };
}

impl Stand {
    /// The things that it is about.
    pub(super) fn anchors(&self) -> impl Iterator<Item = EntityId> {
        let named: [Option<&EntityId>; 2] = of_stand!(self);
        named.into_iter().flatten().copied()
    }

    /// The thing that it is about first, if it is about one.
    pub(crate) fn anchor(&self) -> Option<EntityId> {
        self.anchors().next()
    }

    /// The same, for who puts others in their stead.
    pub(super) fn anchors_mut(&mut self) -> impl Iterator<Item = &mut EntityId> {
        let named: [Option<&mut EntityId>; 2] = of_stand!(self);
        named.into_iter().flatten()
    }
}

impl Line {
    /// The things that it leads along.
    pub(super) fn anchors(&self) -> impl Iterator<Item = EntityId> {
        let named: [Option<&EntityId>; 2] = of_line!(self);
        named.into_iter().flatten().copied()
    }

    /// The same, for who puts others in their stead.
    pub(super) fn anchors_mut(&mut self) -> impl Iterator<Item = &mut EntityId> {
        let named: [Option<&mut EntityId>; 2] = of_line!(self);
        named.into_iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::id::RoadId;

    use super::*;

    fn seen(stands: &[Stand]) -> Vec<Vec<EntityId>> {
        stands.iter().map(|stand| stand.anchors().collect()).collect()
    }

    #[test]
    fn who_looks_at_anchors_and_who_changes_them_see_the_same() {
        let ids = [1, 2, 7, 8].map(|index| EntityId::new(index, 0));
        let [one, other, new, newer] = ids;
        let mut stands = [
            Stand::Between { one, other },
            Stand::AtEdgeOf { anchor: one },
            Stand::AlongRoad { roads: vec![RoadId(3)] },
        ];
        assert_eq!(seen(&stands), [vec![one, other], vec![one], vec![]]);
        assert_eq!(stands.each_ref().map(Stand::anchor), [Some(one), Some(one), None]);
        for anchor in stands.iter_mut().flat_map(Stand::anchors_mut) {
            *anchor = if *anchor == one { new } else { newer };
        }
        assert_eq!(seen(&stands), [vec![new, newer], vec![new], vec![]]);

        let mut line = Line::Between { one, other };
        line.anchors_mut().for_each(|anchor| *anchor = new);
        assert_eq!(line.anchors().collect::<Vec<_>>(), [new, new]);
    }
}
