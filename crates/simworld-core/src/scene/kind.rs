//! What an entity is, and what it is for.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Declares an enum whose variants have a snake-case name, listed and parsed from one table.
macro_rules! named_kinds {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident = $text:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(rename_all = "snake_case")]
        #[non_exhaustive]
        pub enum $name {
            $($(#[$variant_doc])* $variant,)+
        }

        impl $name {
            /// Every variant, in the order of declaration.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)+];

            /// The name in files and prompts.
            pub const fn as_str(self) -> &'static str {
                match self {
                    $(Self::$variant => $text,)+
                }
            }

            /// The variant of that name.
            pub fn from_name(name: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|kind| kind.as_str() == name)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.as_str())
            }
        }
    };
}

named_kinds! {
    /// What an entity is: the least that sensors, physics and language all need to know of it.
    EntityKind {
        /// The surface everything else stands on.
        Ground = "ground",
        /// A carriageway.
        Road = "road",
        /// A raised walkway beside a road.
        Sidewalk = "sidewalk",
        /// A marked strip on which pedestrians cross.
        Crosswalk = "crosswalk",
        /// A building.
        Building = "building",
        /// A tree.
        Tree = "tree",
        /// A shrub, hedge or flower bed.
        Shrub = "shrub",
        /// A street lamp.
        StreetLamp = "street_lamp",
        /// A traffic light.
        TrafficSignal = "traffic_signal",
        /// A sign on a post.
        Sign = "sign",
        /// A bench, a seat for several.
        Bench = "bench",
        /// A chair, a seat for one.
        Chair = "chair",
        /// A table.
        Table = "table",
        /// A bin.
        TrashBin = "trash_bin",
        /// A mailbox.
        Mailbox = "mailbox",
        /// A hydrant.
        Hydrant = "hydrant",
        /// A traffic cone.
        Cone = "cone",
        /// A shelter at a bus stop.
        BusStop = "bus_stop",
        /// Any other fixed object of the street.
        Prop = "prop",
        /// Something one carries in one hand.
        Parcel = "parcel",
        /// A passenger car.
        Car = "car",
        /// A lorry.
        Truck = "truck",
        /// A bus.
        Bus = "bus",
        /// A motorcycle.
        Motorcycle = "motorcycle",
        /// A bicycle.
        Bicycle = "bicycle",
        /// An electric kick scooter.
        Scooter = "scooter",
        /// A human being.
        Person = "person",
        /// A four-legged robot or animal.
        Dog = "dog",
        /// Any other robot.
        Robot = "robot",
        /// A door in a wall.
        Door = "door",
    }
}

impl EntityKind {
    /// Whether bodies always collide with it; surfaces are flat, parcels are carried, and a door stops one only while it is
    /// closed (see [`EntityRef::is_solid`](super::EntityRef::is_solid)).
    pub const fn is_solid(self) -> bool {
        !matches!(
            self,
            Self::Ground
                | Self::Road
                | Self::Sidewalk
                | Self::Crosswalk
                | Self::Shrub
                | Self::Parcel
                | Self::Door
        )
    }

    /// Whether it moves by itself.
    pub const fn is_mobile(self) -> bool {
        self.is_vehicle() || matches!(self, Self::Person | Self::Dog | Self::Robot)
    }

    /// Whether it drives on wheels.
    pub const fn is_vehicle(self) -> bool {
        matches!(self, Self::Car | Self::Truck | Self::Bus | Self::Motorcycle | Self::Bicycle | Self::Scooter)
    }

    /// Whether somebody can sit on it.
    pub const fn is_seat(self) -> bool {
        matches!(self, Self::Bench | Self::Chair)
    }
}

named_kinds! {
    /// What a building or an area is used for: the words by which people name their destinations.
    Place {
        /// A dwelling.
        Home = "home",
        /// A restaurant, where delivery orders start.
        Restaurant = "restaurant",
        /// A shop, where drinks and scooters are sold.
        Store = "store",
        /// A hospital.
        Hospital = "hospital",
        /// A museum.
        Museum = "museum",
        /// A school.
        School = "school",
        /// An office.
        Office = "office",
        /// A factory or warehouse.
        Factory = "factory",
        /// A place to charge vehicles.
        ChargingStation = "charging_station",
        /// A place to rest.
        RestArea = "rest_area",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_serde() {
        for kind in EntityKind::ALL {
            assert_eq!(serde_json::to_string(kind).unwrap(), format!("\"{kind}\""));
            assert_eq!(EntityKind::from_name(kind.as_str()), Some(*kind));
        }
        for place in Place::ALL {
            assert_eq!(serde_json::to_string(place).unwrap(), format!("\"{place}\""));
        }
    }
}
