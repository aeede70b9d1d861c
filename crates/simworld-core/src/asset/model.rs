//! Models: what an asset looks like and is met as, finer than its collider.

use serde::{Deserialize, Serialize};

use super::finish::{BRIGHTEST, Finish, MOST_CUTOFF, ModelTexture, Pictures, Transparency};
use super::image::{Content, MOST_PIXELS, ModelImage};
use super::model_error::ModelError;
use super::rig::Rig;
use crate::geometry::Vector3;

/// How far a point of a model may be from its origin, m.
pub const LARGEST_MODEL: f32 = 1000.0;

/// How far a vertex may be from the picture on its part, in the picture's sides.
pub const FARTHEST_PLACE: f32 = 1e5;

/// How much larger or smaller a model may be than its asset's collider, m.
const MISFIT: f64 = 0.02;

/// A solid with a surface: triangles to look at, and convex hulls to meet.
///
/// Body frame in metres, x forward, y left, z up; the origin is the middle of its bottom. An entity whose shape is larger than
/// its asset's collider has the model stretched by the ratio of both boxes in each direction. Vertices and hulls are the model at rest: what a
/// rig moves is seen to move, and is met where it rests.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Model {
    /// The corners of the triangles.
    pub vertices: Vec<ModelVertex>,
    /// Three vertices each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Runs of triangles of one look, in order; together they are all of them.
    pub parts: Vec<ModelPart>,
    /// Convex solids that together are what bodies meet.
    pub hulls: Vec<Hull>,
    /// The pictures that lie on its parts.
    #[serde(default)]
    pub images: Vec<ModelImage>,
    /// How it moves, if it does.
    #[serde(default)]
    pub rig: Option<Rig>,
    /// By vertex, the way to the right on the pictures of its part: along the surface, body frame, of length 1; and beside it to which side of that the top
    /// of the pictures is: 1 where it is to the left, seen from outside, as of pictures that are not mirrored, -1 where it is to the right, and zeros where
    /// none is known. Bumps are told in that frame, and without it in that of each triangle. Empty where no vertex has one.
    #[serde(default)]
    pub tangents: Vec<[f32; 4]>,
}

/// A corner of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelVertex {
    /// Body frame, m.
    pub position: [f32; 3],
    /// Outward, of length 1.
    pub normal: [f32; 3],
    /// Colour, linear-light sRGB primaries in [0, 1]; times that of the picture on its part, if there is one.
    pub color: [f32; 3],
    /// Where it lies on the picture of its part: from the left edge rightwards and from the top downwards, in shares of the picture's
    /// sides, beyond [0, 1] where the picture goes on.
    #[serde(default)]
    pub place: [f32; 2],
    /// How much is there, 0 to 1; times that of the picture on its part. What follows from it the part [says](ModelPart::transparency).
    #[serde(default = "whole")]
    pub alpha: f32,
}

const fn whole() -> f32 {
    1.0
}

impl Default for ModelVertex {
    /// At the origin, without a normal, black, and all of it there.
    fn default() -> Self {
        Self { position: [0.0; 3], normal: [0.0; 3], color: [0.0; 3], place: [0.0; 2], alpha: whole() }
    }
}

/// A run of triangles of one look.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ModelPart {
    /// What it is: `leg`, `lid`, `lamp`; a name for people.
    pub name: String,
    /// How many triangles it has.
    pub triangles: u32,
    /// Whose colour it has.
    pub paint: Paint,
    /// How it takes light.
    #[serde(default)]
    pub finish: Finish,
    /// The picture on it.
    #[serde(default)]
    pub texture: Option<ModelTexture>,
    /// What becomes of it where its alpha is below 1.
    #[serde(default)]
    pub transparency: Transparency,
    /// Pictures that say place by place how it takes light.
    #[serde(default)]
    pub pictures: Pictures,
    /// Whether its triangles are seen from both sides, as leaves, flags and panes are. Others are seen from where their corners run counter-clockwise.
    #[serde(default)]
    pub two_sided: bool,
}

/// Whose colour a part has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Paint {
    /// The colour of its vertices, whatever the entity is painted.
    #[default]
    Own,
    /// The colour of the entity, times that of its vertices.
    Entity,
}

/// A convex solid: the hull of its points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hull {
    /// Body frame, m.
    pub points: Vec<[f32; 3]>,
}

impl Model {
    /// The lowest and the highest corner of the box around its vertices, m; none without vertices.
    pub fn bounds(&self) -> Option<[[f32; 3]; 2]> {
        let first = self.vertices.first()?.position;
        Some(self.vertices.iter().fold([first, first], |[low, high], vertex| {
            let position = vertex.position;
            [
                std::array::from_fn(|axis| low[axis].min(position[axis])),
                std::array::from_fn(|axis| high[axis].max(position[axis])),
            ]
        }))
    }

    /// Its parts with the triangles of each.
    pub fn runs(&self) -> impl Iterator<Item = (&ModelPart, &[[u32; 3]])> {
        let mut left = &self.triangles[..];
        self.parts.iter().map(move |part| {
            let (own, rest) = left.split_at((part.triangles as usize).min(left.len()));
            left = rest;
            (part, own)
        })
    }

    /// Checks that it is a model, and one that stands in a collider of that size (length, width, height, m).
    ///
    /// # Errors
    /// Nothing to see or to meet, numbers that are none, triangles without vertices, pictures that are none or not there, another
    /// size than the collider's.
    pub fn validate(&self, collider: Vector3) -> Result<(), ModelError> {
        self.validate_surface(collider)?;
        if self.hulls.is_empty() {
            return Err(ModelError::Empty { what: "hull" });
        }
        for (index, hull) in self.hulls.iter().enumerate() {
            if hull.points.len() < 4 {
                return Err(ModelError::Hull { index, points: hull.points.len() });
            }
            for point in &hull.points {
                checked("a point of hull", index, *point, LARGEST_MODEL)?;
            }
        }
        Ok(())
    }

    /// Checks all of it that is seen, and nothing that is met: that it is a surface which fills a box of that size (length, width, height,
    /// m) standing on the origin.
    ///
    /// # Errors
    /// As [`validate`](Self::validate), but for hulls.
    pub fn validate_surface(&self, size: Vector3) -> Result<(), ModelError> {
        if self.triangles.is_empty() {
            return Err(ModelError::Empty { what: "triangle" });
        }
        for (index, vertex) in self.vertices.iter().enumerate() {
            checked("the position of vertex", index, vertex.position, LARGEST_MODEL)?;
            checked("the normal of vertex", index, vertex.normal, 1.01)?;
            checked("the colour of vertex", index, vertex.color, 1.0)?;
            let [right, down] = vertex.place;
            checked("the place on a picture of vertex", index, [right, down, 0.0], FARTHEST_PLACE)?;
            if !(0.0..=1.0).contains(&vertex.alpha) {
                let value = [vertex.alpha, 0.0, 0.0];
                return Err(ModelError::Number { what: "the alpha of vertex", index, value });
            }
        }
        let count = self.vertices.len();
        for (index, triangle) in self.triangles.iter().enumerate() {
            if let Some(vertex) = triangle.iter().copied().find(|vertex| *vertex as usize >= count) {
                return Err(ModelError::Vertex { index, vertex, count });
            }
        }
        let parts = self.parts.iter().map(|part| u64::from(part.triangles)).sum();
        if parts != self.triangles.len() as u64 {
            return Err(ModelError::Parts { parts, triangles: self.triangles.len() });
        }
        if let Some(rig) = self.rig.as_ref().map(|rig| rig.desc().vertices.len()).filter(|rig| *rig != count)
        {
            return Err(ModelError::Rig { rig, vertices: count });
        }
        self.validate_tangents()?;
        self.validate_looks()?;
        self.fits(size)
    }

    fn validate_tangents(&self) -> Result<(), ModelError> {
        let (tangents, vertices) = (self.tangents.len(), self.vertices.len());
        if tangents != 0 && tangents != vertices {
            return Err(ModelError::Tangents { tangents, vertices });
        }
        for (index, [x, y, z, side]) in self.tangents.iter().enumerate() {
            checked("the tangent of vertex", index, [*x, *y, *z], 1.01)?;
            if ![-1.0, 0.0, 1.0].contains(side) {
                let value = [*side, 0.0, 0.0];
                return Err(ModelError::Number { what: "the side of the tangent of vertex", index, value });
            }
        }
        Ok(())
    }

    fn validate_looks(&self) -> Result<(), ModelError> {
        for (index, part) in self.parts.iter().enumerate() {
            self.validate_part(index, part)?;
        }
        if let Some((index, image)) = self.images.iter().enumerate().find(|(_, image)| !image.is_whole()) {
            let bytes = image.pixels.len();
            return Err(ModelError::Picture { index, width: image.width, height: image.height, bytes });
        }
        let pixels = self.images.iter().map(|image| u64::from(image.width) * u64::from(image.height)).sum();
        if pixels > MOST_PIXELS { Err(ModelError::Pixels { pixels }) } else { Ok(()) }
    }

    fn validate_part(&self, part: usize, look: &ModelPart) -> Result<(), ModelError> {
        let (finish, transparency, pictures) = (look.finish, look.transparency, look.pictures);
        let shares = [finish.metallic, finish.roughness].iter().all(|share| (0.0..=1.0).contains(share));
        if !shares || !finish.emission.iter().all(|light| (0.0..=BRIGHTEST).contains(light)) {
            return Err(ModelError::Finish { part, finish });
        }
        if let Transparency::Cutout { cutoff } = transparency
            && !(0.0..=MOST_CUTOFF).contains(&cutoff)
        {
            return Err(ModelError::Transparency { part, transparency });
        }
        if !pictures.is_sound() {
            return Err(ModelError::Pictures { part, pictures });
        }
        let own = look.texture.map(|texture| (texture, Content::Color));
        for (ModelTexture { image, .. }, wanted) in own.into_iter().chain(pictures.all()) {
            let count = self.images.len();
            let Some(found) = self.images.get(image as usize) else {
                return Err(ModelError::Image { part, image, count });
            };
            if found.content != wanted {
                return Err(ModelError::Content { part, image, wanted, content: found.content });
            }
        }
        Ok(())
    }

    fn fits(&self, collider: Vector3) -> Result<(), ModelError> {
        let Some([low, high]) = self.bounds() else { return Err(ModelError::Empty { what: "vertex" }) };
        let [low, high] = [low, high].map(|corner| corner.map(f64::from));
        let half = collider * 0.5;
        let wanted = [[-half.x, -half.y, 0.0], [half.x, half.y, collider.z]];
        let is_near =
            |got: [f64; 3], want: [f64; 3]| (0..3).all(|axis| (got[axis] - want[axis]).abs() <= MISFIT);
        if is_near(low, wanted[0]) && is_near(high, wanted[1]) {
            return Ok(());
        }
        let model = std::array::from_fn(|axis| high[axis] - low[axis]);
        Err(ModelError::Size { model, collider: collider.into() })
    }
}

fn checked(what: &'static str, index: usize, value: [f32; 3], limit: f32) -> Result<(), ModelError> {
    let is_sound = value.iter().all(|number| number.is_finite() && number.abs() <= limit);
    if is_sound { Ok(()) } else { Err(ModelError::Number { what, index, value }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{LONGEST_IMAGE, Wrap};

    fn wedge() -> Model {
        let corners = [[-0.5, -0.5, 0.0], [0.5, -0.5, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 1.0]];
        let vertex = |position| ModelVertex {
            position,
            normal: [0.0, 0.0, 1.0],
            color: [0.5; 3],
            ..ModelVertex::default()
        };
        Model {
            vertices: corners.map(vertex).to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
            parts: vec![ModelPart { name: "wedge".to_owned(), triangles: 4, ..ModelPart::default() }],
            hulls: vec![Hull { points: corners.to_vec() }],
            ..Model::default()
        }
    }

    #[test]
    fn a_model_stands_in_its_collider() {
        assert_eq!(wedge().validate(Vector3::new(1.0, 1.0, 1.0)), Ok(()));
        let error = wedge().validate(Vector3::new(1.0, 1.0, 2.0)).unwrap_err();
        assert!(matches!(error, ModelError::Size { .. }), "{error}");
    }

    #[test]
    fn every_triangle_is_in_the_run_of_its_part() {
        let part =
            |name: &str, triangles| ModelPart { name: name.to_owned(), triangles, ..ModelPart::default() };
        let model = Model { parts: vec![part("front", 1), part("none", 0), part("rest", 3)], ..wedge() };
        let runs: Vec<(&str, &[[u32; 3]])> =
            model.runs().map(|(part, triangles)| (part.name.as_str(), triangles)).collect();
        let all = &model.triangles;
        assert_eq!(runs, [("front", &all[..1]), ("none", &[][..]), ("rest", &all[1..])]);
    }

    #[test]
    fn what_is_no_model_says_so() {
        let is_none = |spoil: fn(&mut Model)| {
            let mut model = wedge();
            spoil(&mut model);
            model.validate(Vector3::new(1.0, 1.0, 1.0)).unwrap_err()
        };
        assert!(matches!(is_none(|model| model.triangles.clear()), ModelError::Empty { .. }));
        assert!(matches!(is_none(|model| model.hulls.clear()), ModelError::Empty { .. }));
        assert!(matches!(is_none(|model| model.triangles[0][1] = 4), ModelError::Vertex { .. }));
        assert!(matches!(is_none(|model| model.parts[0].triangles = 3), ModelError::Parts { .. }));
        assert!(matches!(is_none(|model| model.hulls[0].points.truncate(3)), ModelError::Hull { .. }));
        assert!(matches!(
            is_none(|model| model.vertices[2].position[1] = f32::NAN),
            ModelError::Number { .. }
        ));
        assert!(matches!(is_none(|model| model.vertices[0].color[0] = 2.0), ModelError::Number { .. }));
        assert!(matches!(is_none(|model| model.vertices[0].place[1] = f32::NAN), ModelError::Number { .. }));
        assert!(matches!(is_none(|model| model.vertices[0].alpha = 1.5), ModelError::Number { .. }));
        assert!(matches!(is_none(|model| model.vertices[0].alpha = -0.1), ModelError::Number { .. }));
        let tangent = [0.6, 0.0, 0.8, -1.0];
        let laid = Model { tangents: vec![tangent; 4], ..wedge() };
        assert_eq!(laid.validate(Vector3::new(1.0, 1.0, 1.0)), Ok(()));
        assert!(matches!(
            is_none(|model| model.tangents = vec![[0.0; 4]; 3]),
            ModelError::Tangents { tangents: 3, vertices: 4 }
        ));
        for wrong in [[f32::NAN, 0.0, 0.0, 1.0], [1.0, 1.0, 1.5, 1.0], [1.0, 0.0, 0.0, 0.5]] {
            let mut model = Model { tangents: vec![tangent; 4], ..wedge() };
            model.tangents[2] = wrong;
            let error = model.validate(Vector3::new(1.0, 1.0, 1.0)).unwrap_err();
            assert!(matches!(error, ModelError::Number { index: 2, .. }), "{error}");
        }
    }

    #[test]
    fn what_is_no_look_says_so() {
        let with = |finish: Finish, image: u32, images: Vec<ModelImage>| {
            let mut model = Model { images, ..wedge() };
            let texture = Some(ModelTexture { image, wrap: [Wrap::Repeat; 2] });
            model.parts[0] = ModelPart { finish, texture, ..model.parts[0].clone() };
            model.validate(Vector3::new(1.0, 1.0, 1.0))
        };
        let plain = |width: u32, height: u32| {
            let pixels = vec![9; width as usize * height as usize * 3];
            ModelImage { width, height, pixels, ..ModelImage::default() }
        };
        let dull = Finish::default();
        assert_eq!(with(dull, 0, vec![plain(3, 1)]), Ok(()));
        for finish in [
            Finish { metallic: 1.5, ..dull },
            Finish { roughness: f32::NAN, ..dull },
            Finish { emission: [0.0, -1.0, 0.0], ..dull },
            Finish { emission: [0.0, 0.0, f32::INFINITY], ..dull },
        ] {
            let error = with(finish, 0, vec![plain(3, 1)]).unwrap_err();
            assert!(matches!(error, ModelError::Finish { part: 0, .. }), "{error}");
        }
        assert!(matches!(
            with(dull, 1, vec![plain(3, 1)]),
            Err(ModelError::Image { image: 1, count: 1, .. })
        ));
        for image in [
            ModelImage::default(),
            ModelImage { width: 4, ..plain(3, 1) },
            ModelImage { width: u32::MAX, height: u32::MAX, ..ModelImage::default() },
            ModelImage { alpha: vec![0; 2], ..plain(3, 1) },
            plain(LONGEST_IMAGE + 1, 1),
        ] {
            let error = with(dull, 0, vec![image]).unwrap_err();
            assert!(matches!(error, ModelError::Picture { index: 0, .. }), "{error}");
        }
        let many = vec![plain(LONGEST_IMAGE, LONGEST_IMAGE / 2); 3];
        assert!(matches!(with(dull, 0, many), Err(ModelError::Pixels { .. })));
    }

    #[test]
    fn what_is_no_cutout_and_no_picture_of_light_says_so() {
        let image = |content| {
            let pixels = vec![9; 3];
            ModelImage { width: 1, height: 1, pixels, content, ..ModelImage::default() }
        };
        let with = |spoil: &dyn Fn(&mut ModelPart)| {
            let mut model = Model { images: vec![image(Content::Color), image(Content::Numbers)], ..wedge() };
            spoil(&mut model.parts[0]);
            model.validate(Vector3::new(1.0, 1.0, 1.0))
        };
        let on = |image| Some(ModelTexture { image, wrap: [Wrap::Repeat; 2] });
        for cutoff in [0.0, 0.5, 1.0, MOST_CUTOFF] {
            assert_eq!(with(&|part| part.transparency = Transparency::Cutout { cutoff }), Ok(()));
        }
        for cutoff in [f32::NAN, f32::INFINITY, -0.1, 2.1] {
            let error = with(&|part| part.transparency = Transparency::Cutout { cutoff }).unwrap_err();
            assert!(matches!(error, ModelError::Transparency { part: 0, .. }), "{error}");
        }
        let all =
            Pictures { metal: on(1), emission: on(0), shade: on(1), bumps: on(1), ..Pictures::default() };
        assert_eq!(with(&|part| part.pictures = all), Ok(()));
        for pictures in [
            Pictures { shade_strength: 1.5, ..all },
            Pictures { shade_strength: f32::NAN, ..all },
            Pictures { bump_scale: f32::INFINITY, ..all },
            Pictures { bump_scale: f32::NAN, ..all },
        ] {
            let error = with(&|part| part.pictures = pictures).unwrap_err();
            assert!(matches!(error, ModelError::Pictures { part: 0, .. }), "{error}");
        }
        for pictures in [Pictures { bumps: on(0), ..all }, Pictures { emission: on(1), ..all }] {
            let error = with(&|part| part.pictures = pictures).unwrap_err();
            assert!(matches!(error, ModelError::Content { part: 0, .. }), "{error}");
        }
        let error = with(&|part| part.pictures = Pictures { shade: on(2), ..all }).unwrap_err();
        assert!(matches!(error, ModelError::Image { image: 2, count: 2, .. }), "{error}");
        assert!(matches!(with(&|part| part.texture = on(1)), Err(ModelError::Content { .. })));
    }
}
