//! What the fuzz targets check, of a few inputs each: it is built with all else here, so that no target rots between two runs of a
//! fuzzer. That of bodies is a test of the physics already.

use std::path::Path;

#[path = "../../fuzz/checks/city_file.rs"]
mod city_file;
#[path = "../../fuzz/checks/glb.rs"]
mod glb;
#[path = "../../fuzz/checks/layout.rs"]
mod layout;
#[path = "../../fuzz/checks/library.rs"]
mod library;
#[path = "../../fuzz/checks/mjcf.rs"]
mod mjcf;
#[path = "../../fuzz/checks/opendrive.rs"]
mod opendrive;
#[path = "../../fuzz/checks/osm_pbf.rs"]
mod osm_pbf;
#[path = "../../fuzz/checks/osm_xml.rs"]
mod osm_xml;
#[path = "../../fuzz/checks/remote.rs"]
mod remote;
#[path = "../../fuzz/checks/robots.rs"]
mod robots;
#[path = "../../fuzz/checks/scene_file.rs"]
mod scene_file;
#[path = "../../fuzz/checks/sumo_demand.rs"]
mod sumo_demand;
#[path = "../../fuzz/checks/sumo_net.rs"]
mod sumo_net;
#[path = "../../fuzz/checks/urdf.rs"]
mod urdf;

/// What a target checks of any input.
type Check = fn(&[u8]);

/// Every target by its name, with an input of its kind.
const TARGETS: [(&str, Check, &[u8]); 13] = [
    ("city_file", city_file::check, &[0xf5; 12]),
    ("glb", glb::check, b"glTF\x02\0\0\0\x14\0\0\0\0\0\0\0JSON"),
    ("layout", layout::check, br#"{"roads": [], "buildings": [], "elements": []}"#),
    (
        "library",
        library::check,
        b"name = \"harbour\"\n[[asset]]\nname = \"buoy\"\nmodel = \"../../buoy.glb\"\n",
    ),
    (
        "mjcf",
        mjcf::check,
        br#"<mujoco><worldbody><body><geom type="box" size=".1 .1 .1"/></body></worldbody></mujoco>"#,
    ),
    ("opendrive", opendrive::check, b"<OpenDRIVE><header revMajor=\"1\" revMinor=\"6\"/></OpenDRIVE>"),
    ("osm_pbf", osm_pbf::check, &[0x0a, 0x02, 0x0a, 0x00]),
    ("osm_xml", osm_xml::check, br#"<osm version="0.6"><node id="1" lat="0" lon="0"/></osm>"#),
    ("remote", remote::check, b"\x07vget /objects"),
    (
        "scene_file",
        scene_file::check,
        b"version = 1\n[[thing]]\nasset = \"cone\"\nat = [1, 2.5]\nfacing = \"north\"\n",
    ),
    (
        "sumo_demand",
        sumo_demand::check,
        br#"<routes><trip id="0" depart="0" from="A0A1" to="A1A0"/></routes>"#,
    ),
    ("sumo_net", sumo_net::check, br#"<net version="1.20"></net>"#),
    ("urdf", urdf::check, br#"<robot name="box"><link name="base"/></robot>"#),
];

#[test]
fn what_is_fuzzed_is_refused_or_sound() {
    for (_, check, own) in TARGETS {
        for input in [own, b"", b"{", b"<a>", &own[..own.len() / 2], &[0xff; 64]] {
            check(input);
        }
    }
}

#[test]
fn every_target_is_among_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/fuzz_targets");
    let files = std::fs::read_dir(folder).expect("the targets are beside the tests");
    let named = |file: std::io::Result<std::fs::DirEntry>| {
        let path = file.expect("it can be listed").path();
        path.file_stem().expect("it has a name").to_string_lossy().into_owned()
    };
    let mut found: Vec<String> = files.map(named).filter(|name| name != "bodies").collect();
    found.sort_unstable();
    assert_eq!(found, TARGETS.map(|(name, ..)| name));
}
