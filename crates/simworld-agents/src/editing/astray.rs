//! What stands where it does not belong, for want of better ground.

use super::land::Land;

/// Things on ground that is for something else: nothing better was found where they were asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Astray {
    /// What they are.
    pub what: String,
    /// On what ground they stand.
    pub land: Land,
    /// Where they were asked for, in words; nothing if that was not said.
    pub place: String,
    /// How many.
    pub count: usize,
}

impl Astray {
    /// That they stand there, and why: "the car stands on a lawn or other soil, for nothing better was found next to the clinic".
    pub fn told(&self) -> String {
        let Self { what, land, place, count } = self;
        let place: &str = if place.is_empty() { "around here" } else { place };
        let who = match count {
            1 => format!("the {what} stands"),
            many => format!("{many} of kind {what} stand"),
        };
        format!("{who} {}, for nothing better was found {place}", land.told())
    }

    /// Counts another to those on the same ground in the same place.
    pub(super) fn add_to(self, all: &mut Vec<Self>) {
        let is_same = |other: &&mut Self| {
            (&other.what, other.land, &other.place) == (&self.what, self.land, &self.place)
        };
        if let Some(same) = all.iter_mut().find(is_same) {
            same.count += self.count;
        } else {
            all.push(self);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn those_on_the_same_ground_are_counted_together() {
        let car =
            |land| Astray { what: "car".to_owned(), land, place: "next to the clinic".to_owned(), count: 1 };
        let mut all = Vec::new();
        for land in [Land::Green, Land::Lot, Land::Green] {
            car(land).add_to(&mut all);
        }
        let told: Vec<String> = all.iter().map(Astray::told).collect();
        assert_eq!(
            told,
            [
                "2 of kind car stand on a lawn or other soil, for nothing better was found next to the clinic",
                "the car stands on open ground beside a street, for nothing better was found next to the clinic",
            ]
        );
    }
}
