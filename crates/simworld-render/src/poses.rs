//! Which poses of a model are kept ready: as many as there is room for, and always those that are wanted now. The others give their place
//! to those that come, the one first that was not wanted for longest.

use std::collections::BTreeMap;

use simworld_core::asset::RigPose;

/// Bytes that the poses of one model take on the device, beside those that are wanted at once.
const ROOM: u64 = 32 << 20;

/// What is kept for each of some poses.
#[derive(Debug)]
pub(crate) struct Poses<T> {
    kept: BTreeMap<RigPose, Kept<T>>,
    most: usize,
}

#[derive(Debug)]
struct Kept<T> {
    what: T,
    /// When it was wanted last.
    wanted: u64,
}

impl<T> Poses<T> {
    /// None yet, each of which will take so many bytes.
    pub(crate) fn of_bytes(bytes: u64) -> Self {
        Self { kept: BTreeMap::new(), most: (ROOM / bytes.max(1)) as usize }
    }

    pub(crate) fn get(&self, pose: RigPose) -> Option<&T> {
        self.kept.get(&pose).map(|kept| &kept.what)
    }

    /// Notes that a pose is wanted now; true if it is there.
    pub(crate) fn want(&mut self, pose: RigPose, now: u64) -> bool {
        self.kept.get_mut(&pose).is_some_and(|kept| {
            kept.wanted = now;
            true
        })
    }

    /// Takes what a pose had that nobody wants now, if there is no room for more.
    pub(crate) fn spare(&mut self, now: u64) -> Option<T> {
        if self.kept.len() < self.most {
            return None;
        }
        let idle = self.kept.iter().filter(|(_, kept)| kept.wanted < now);
        let longest = *idle.min_by_key(|(_, kept)| kept.wanted)?.0;
        self.kept.remove(&longest).map(|kept| kept.what)
    }

    pub(crate) fn keep(&mut self, pose: RigPose, what: T, now: u64) {
        self.kept.insert(pose, Kept { what, wanted: now });
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::asset::ClipMoment;

    use super::*;

    fn pose(number: u32) -> RigPose {
        RigPose::at(Some(ClipMoment { clip: 0, number }))
    }

    #[test]
    fn places_go_to_those_that_are_wanted() {
        let mut poses = Poses::of_bytes(ROOM / 2);
        for (now, number) in [(1, 10), (2, 11)] {
            assert!(!poses.want(pose(number), now));
            assert_eq!(poses.spare(now), None, "there is room");
            poses.keep(pose(number), number, now);
        }
        assert!(poses.want(pose(10), 3));
        assert_eq!(poses.spare(3), Some(11), "the other one is wanted");
        poses.keep(pose(12), 12, 3);
        assert_eq!(poses.get(pose(11)), None);
        assert_eq!((poses.get(pose(10)), poses.get(pose(12))), (Some(&10), Some(&12)));
        assert_eq!(poses.spare(3), None, "all are wanted: there will be more");
    }
}
