//! Where things go, told round about, with the place first, by what used to be there or by what several form; things that are told by what they are
//! for; and bounds on distances: each comes to the edits of its plain order.

use simworld_agents::editing::{Edit, Stand};

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};

#[test]
fn things_are_told_by_what_they_are_for() {
    mean(
        "harbour",
        "remove the trash bin",
        &["Please to take away the basket for the rubbish.", "Take away the container for the waste."],
    );
    mean(
        "quarter",
        "put a Christmas tree on Market Square",
        &[
            "On the place of market I wish a Christmas tree.",
            "Put a Christmas tree on the place of the market.",
        ],
    );
    mean(
        "harbour",
        "add a bicycle rack across from the bus stop",
        &["Bike stand opposite the bus stop.", "Add a stand for bikes opposite the stop of the bus."],
    );
    mean(
        "harbour",
        "add a cash machine near the Corner Shop",
        &[
            "An ATM close to the store that has coffee and newspapers.",
            "An ATM close to the store that has newspapers as well as coffee.",
        ],
    );
}

#[test]
fn distances_are_bounded_behind_and_before_what_they_are_from() {
    mean(
        "harbour",
        "put a food cart within 15 m of the museum",
        &[
            "No further from the museum than 15 m, somebody should park a food cart.",
            "Park a food cart no farther from the museum than 15 m.",
        ],
    );
    mean(
        "quarter",
        "put a power station at least 100 m from the river",
        &[
            "A hundred metres or more from the river, a power station.",
            "Put a power station a hundred metres or more from the river.",
            "Put a power station no closer to the river than 100 m.",
        ],
    );
    mean("oldtown", "put a campfire 7.5 m north of me", &["Light a campfire ten paces north of me."]);
}

#[test]
fn between_me_and_a_thing_is_a_place() {
    let city = City::read("harbour");
    let edits = edits_of(&city, "Put the scooter halfway between me and the cone.").unwrap();
    assert!(
        matches!(&edits[..], [Edit::Move { stands, .. }]
            if matches!(stands[..], [Stand::Between { one, .. }] if one == city.me)),
        "{edits:?}"
    );
    for (city, words) in [
        ("quarter", "Fit an airport terminal in between me and the cone."),
        ("harbour", "Erect a cathedral between the table and the chair closest to it."),
    ] {
        let refused = edits_of(&City::read(city), words).unwrap_err();
        assert!(refused.contains("no room"), "{words}: {refused}");
    }
}

#[test]
fn a_part_of_a_tree_is_the_tree_where_something_is_put_to_it() {
    let city = City::read("oldtown");
    let plain = edits_of(&city, "Push the red post box inside the tallest lime.");
    assert!(plain.is_err(), "{plain:?}");
    assert_eq!(edits_of(&city, "Push the red post box inside the trunk of the tallest lime."), plain);
    // To paint a trunk is not to paint the tree.
    let painted = edits_of(&city, "Paint the trunk of the tallest lime white.");
    assert!(painted.is_err(), "{painted:?}");
}

#[test]
fn several_form_rings_and_rows() {
    for (city, plain, said) in [
        (
            "oldtown",
            "put ten stone bollards in a ring around the tallest lime",
            "Ten stone bollards are to form a ring about the tallest lime.",
        ),
        (
            "campus",
            "put a dozen traffic cones in a ring around the statue",
            "A dozen traffic cones go round the statue in a circle.",
        ),
        (
            "campus",
            "put six bollards evenly between the statue and the birch",
            "Set half a dozen bollards at equal gaps between the statue and the birch.",
        ),
        (
            "quarter",
            "put three flower pots evenly between the red bench and the fountain",
            "From the red bench to the fountain, three flower pots with equal spaces.",
        ),
        (
            "quarter",
            "plant a willow every 25 m along the river",
            "Willows at 25 m intervals along the river.",
        ),
        (
            "quarter",
            "put a box hedge every 5 m around Rose Park",
            "Border Rose Park with box hedges, spacing five metres.",
        ),
        (
            "oldtown",
            "plant lavender every 3 m between the post box and Spot 7",
            "A line of lavender, a plant every 3 m, from the post box to Spot 7.",
        ),
    ] {
        mean(city, plain, &[said]);
    }
}

#[test]
fn the_place_is_told_first() {
    for (city, plain, said) in [
        (
            "oldtown",
            "add a couple of tourists near the shop that sells sandwiches",
            "Near the shop that sells sandwiches a couple of tourists are loitering.",
        ),
        (
            "oldtown",
            "add a sports hall north of the school and close to the school",
            "North of the school, but close to it, a sports hall.",
        ),
        (
            "campus",
            "add a phone booth across from the kiosk",
            "Opposite the kiosk there used to be a telephone box; bring one back.",
        ),
        (
            "quarter",
            "add a weather station next to the oak on the south side of Oak Street",
            "Beside the oak on the south side of Oak Street, a weather station.",
        ),
    ] {
        mean(city, plain, &[said]);
    }
    // Who asks wants nothing new, and who goes on about what stands there means that.
    let adds = |edits: &Result<Vec<Edit>, String>| {
        edits.as_ref().is_ok_and(|edits| edits.iter().any(|edit| matches!(edit, Edit::Add { .. })))
    };
    for (city, words) in [
        ("harbour", "Left of the Harbour Museum waits a yellow cab?"),
        ("oldtown", "Near the shop that sells sandwiches a couple of tourists are loitering?"),
        ("quarter", "Next to the museum stands a bench; paint it red."),
    ] {
        let edits = edits_of(&City::read(city), words);
        assert!(!adds(&edits), "{words}: {edits:?}");
    }
}

#[test]
fn who_and_what_is_to_be_elsewhere() {
    for (city, plain, said) in [
        (
            "campus",
            "remove the fountain and put a carousel in its place",
            "Out comes the fountain, and a carousel is set up in its place.",
        ),
        (
            "campus",
            "put a flower shop behind the clinic",
            "I would like that it gives a flower shop behind of the clinic.",
        ),
        ("harbour", "move Ben east of Northgate Clinic", "Off you go, Ben: stand east of Northgate Clinic."),
    ] {
        mean(city, plain, &[said]);
    }
}

#[test]
fn streets_are_closed_to_traffic_piece_by_piece() {
    mean(
        "quarter",
        "close Oak Street between Harbour Road and Station Road",
        &["Close Oak Street to traffic between Harbour Road and Station Road."],
    );
    mean("quarter", "reopen the closed half of Mill Lane", &["Reopen the blocked half of Mill Lane."]);
    let edits = edits_of(&City::read("quarter"), "Four taxis on Oak Street.").unwrap();
    assert!(matches!(edits[..], [Edit::Add { count: 4, .. }]), "{edits:?}");
}
