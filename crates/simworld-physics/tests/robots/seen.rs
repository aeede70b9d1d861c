//! What is seen of robots from files: their visuals, meshes too, in place of what is met.
#![cfg(all(feature = "mjcf", feature = "urdf"))]

use std::fs;

use super::robot_files::read_mjcf;
use simworld_core::geometry::Vector3;
use simworld_physics::robot::{Form, ImportOptions, Imported, LinkVisual, VisualForm, mjcf, urdf};

/// A wedge of four corners, once as OBJ.
const WEDGE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("wedge.obj"), WEDGE).unwrap();
        fs::write(folder.path().join("flat.obj"), "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").unwrap();
        Self(folder)
    }

    fn urdf(&self, visuals: &str) -> Imported {
        let text = format!(
            "<robot name=\"r\"><link name=\"a\">\
             <collision><geometry><sphere radius=\"0.1\"/></geometry></collision>{visuals}</link></robot>"
        );
        let options = ImportOptions { folder: Some(self.0.path().to_owned()), ..ImportOptions::default() };
        urdf::from_str(&text, &options).unwrap()
    }
}

fn seen(read: &Imported) -> &[LinkVisual] {
    &read.description.links[0].visuals
}

fn says(read: &Imported, what: &str) -> bool {
    read.report.iter().any(|note| note.to_string().contains(what))
}

#[test]
fn visuals_of_a_urdf_are_seen_where_they_are() {
    let folder = Folder::new();
    let read = folder.urdf(
        "<visual><origin xyz=\"1 2 3\"/><geometry><mesh filename=\"wedge.obj\" scale=\"2 2 4\"/></geometry>\
         <material name=\"red\"><color rgba=\"1 0 0 1\"/></material></visual>\
         <visual><geometry><box size=\"1 2 3\"/></geometry></visual>",
    );
    let [wedge, block] = seen(&read) else { panic!("{:?}", seen(&read)) };
    let VisualForm::Model(model) = &wedge.form else { panic!("{:?}", wedge.form) };
    assert_eq!(model.bounds(), Some([[-1.0, -1.0, 0.0], [1.0, 1.0, 4.0]]));
    assert_eq!(wedge.link_from_visual.translation.vector, Vector3::new(2.0, 3.0, 3.0));
    assert_eq!(wedge.color, Some([1.0, 0.0, 0.0]));
    assert_eq!((model.triangles.len(), model.vertices.len()), (4, 12));
    assert_eq!(block.form, VisualForm::Solid(Form::Box { size: Vector3::new(1.0, 2.0, 3.0) }));
    assert_eq!(block.color, None);
    assert_eq!(read.description.links[0].solids.len(), 1, "it is met as before");
}

/// Every face of the wedge looks away from its middle, whichever way it is scaled.
#[test]
fn a_mirrored_mesh_is_not_inside_out() {
    for scale in ["1 1 1", "1 -1 1", "-1 -1 1", "-1 -1 -1"] {
        let folder = Folder::new();
        let mesh =
            format!("<visual><geometry><mesh filename=\"wedge.obj\" scale=\"{scale}\"/></geometry></visual>");
        let read = folder.urdf(&mesh);
        let VisualForm::Model(model) = &seen(&read)[0].form else { panic!("{scale}") };
        let at = |corner: u32| Vector3::from(model.vertices[corner as usize].position.map(f64::from));
        let middle = model.triangles.iter().flatten().map(|corner| at(*corner)).sum::<Vector3>() / 12.0;
        for corners in &model.triangles {
            let [a, b, c] = corners.map(at);
            assert!((b - a).cross(&(c - a)).dot(&(a - middle)) > 0.0, "{scale}");
        }
    }
}

#[test]
fn what_cannot_be_seen_is_seen_as_what_is_met_and_the_report_says_so() {
    let folder = Folder::new();
    let good = "<visual><geometry><box size=\"1 1 1\"/></geometry></visual>";
    for (bad, why) in [
        ("<mesh filename=\"wheel.dae\"/>", "wheel.dae"),
        ("<mesh filename=\"none.obj\"/>", "none.obj"),
        ("<mesh filename=\"../wedge.obj\"/>", "leads out"),
        ("<mesh filename=\"flat.obj\"/>", "is not drawn"),
        ("<box size=\"0 1 1\"/>", "is not drawn"),
        ("<teapot/>", "teapot"),
    ] {
        let read = folder.urdf(&format!("{good}<visual><geometry>{bad}</geometry></visual>"));
        assert!(seen(&read).is_empty(), "{bad}");
        assert!(says(&read, "seen as what is met") && says(&read, why), "{bad}: {:?}", read.report);
    }
    let same = "<visual><geometry><sphere radius=\"0.1\"/></geometry>\
                <material name=\"b\"><color rgba=\"0 0 1 1\"/></material></visual>";
    let read = folder.urdf(same);
    assert!(seen(&read).is_empty() && read.report.iter().all(|note| !note.what.contains("drawn")));
    assert_eq!(
        read.description.links[0].solids[0].color,
        Some([0.0, 0.0, 1.0]),
        "the solids take the colour"
    );
}

/// By the groups of a viewer: 0 to 2 are shown, others are not, and neither is what is clear.
#[test]
fn geoms_of_an_mjcf_are_seen_by_their_group() {
    let robot = |geoms: &str| {
        let text = format!(
            "<mujoco><worldbody><body name=\"b\"><freejoint/>\
             <geom type=\"sphere\" size=\"0.1\" group=\"3\"/>{geoms}</body></worldbody></mujoco>"
        );
        read_mjcf(&text).unwrap()
    };
    let read = robot("");
    assert!(seen(&read).is_empty() && read.description.links[0].solids.len() == 1);
    let read = robot(
        "<geom type=\"box\" size=\"0.1 0.2 0.3\" contype=\"0\" conaffinity=\"0\" group=\"2\" rgba=\"0 1 0 1\"/>\
         <geom type=\"box\" size=\"9 9 9\" contype=\"0\" conaffinity=\"0\" rgba=\"0 1 0 0\"/>",
    );
    let [shell] = seen(&read) else { panic!("{:?}", seen(&read)) };
    assert_eq!(shell.form, VisualForm::Solid(Form::Box { size: Vector3::new(0.2, 0.4, 0.6) }));
    assert_eq!(shell.color, Some([0.0, 1.0, 0.0]));
    assert_eq!(read.description.links[0].solids.len(), 1);
}

#[test]
fn a_mesh_of_an_mjcf_is_seen_as_its_surface() {
    let folder = Folder::new();
    let text = "<mujoco><asset><mesh name=\"w\" file=\"wedge.obj\"/></asset><worldbody><body name=\"b\"><freejoint/>\
                <geom type=\"mesh\" mesh=\"w\" pos=\"0 0 1\"/></body></worldbody></mujoco>";
    let options = ImportOptions { folder: Some(folder.0.path().to_owned()), ..ImportOptions::default() };
    let read = mjcf::from_str(text, &options).unwrap();
    let [wedge] = seen(&read) else { panic!("{:?}", seen(&read)) };
    assert!(matches!(&wedge.form, VisualForm::Model(model) if model.triangles.len() == 4));
    assert_eq!(wedge.link_from_visual.translation.vector, Vector3::new(0.5, 0.5, 1.0));
    assert_eq!(read.description.links[0].solids.len(), 1, "and met as its hull");
}
