//! What is written to a PNG can be read back from it.

use crate::common::{draw, renderer, square, square_camera};
use simworld_render::{Frame, PNG_DEPTH_LIMIT, RenderConfig, classes};

fn decode(bytes: &[u8]) -> (png::OutputInfo, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut pixels).expect("an image");
    (info, pixels)
}

fn by_hand() -> Frame {
    let mut frame = Frame::new();
    frame.resize(3, 2);
    frame.rgb = (0..18).map(|byte| byte * 14).collect();
    frame.depth = vec![0.001, 1.2345, 65.535, 900.0, f32::INFINITY, 20.0];
    frame.classes = vec![7, 8, 11, 24, 23, 26];
    frame.ids = vec![1, 1, 2, 3, 0, 9];
    frame
}

#[test]
fn values_survive_the_file() {
    let frame = by_hand();
    let (info, pixels) = decode(&frame.rgb_png().expect("a frame"));
    assert_eq!((info.width, info.height, &pixels), (3, 2, &frame.rgb));
    let (info, pixels) = decode(&frame.depth_png().expect("a frame"));
    let millimetres: Vec<u16> = pixels.chunks_exact(2).map(|b| u16::from_be_bytes([b[0], b[1]])).collect();
    assert_eq!(info.bit_depth, png::BitDepth::Sixteen);
    assert_eq!(millimetres, [1, 1235, 65535, 65535, 0, 20000]);
    assert_eq!(PNG_DEPTH_LIMIT, 65.535);
    let (info, pixels) = decode(&frame.classes_png().expect("a frame"));
    assert_eq!(info.color_type, png::ColorType::Indexed);
    assert_eq!(pixels, frame.classes);
    let (_, pixels) = decode(&frame.ids_png().expect("a frame"));
    assert_eq!(pixels[0..3], pixels[3..6], "one entity has one colour");
    assert_ne!(pixels[0..3], pixels[6..9], "two entities have two");
    assert_eq!(pixels[12..15], [0; 3], "the sky is black");
}

#[test]
fn the_palette_is_that_of_cityscapes() {
    let file = by_hand().classes_png().expect("a frame");
    let reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().expect("a PNG");
    let palette = reader.info().palette.clone().expect("a palette");
    for class in classes::CLASSES {
        let first = 3 * usize::from(class.id);
        assert_eq!(palette[first..first + 3], class.color, "{}", class.name);
    }
}

#[test]
fn a_drawn_frame_is_written_to_four_files() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let frame = draw(&mut renderer, &square(0.0), &square_camera(0.0, 80, 60));
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    frame.write_png(file("rgb.png")).expect("written");
    frame.write_depth_png(file("depth.png")).expect("written");
    frame.write_classes_png(file("classes.png")).expect("written");
    frame.write_ids_png(file("ids.png")).expect("written");
    for name in ["rgb.png", "depth.png", "classes.png", "ids.png"] {
        let (info, _) = decode(&std::fs::read(file(name)).expect("it is there"));
        assert_eq!((info.width, info.height), (80, 60), "{name}");
    }
}
