//! Videos: AV1 in MP4, encoded in this process.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use muxide::api::{Muxer, MuxerBuilder, VideoCodec};
use rav1e::prelude::{
    ChromaSampling, ColorDescription, ColorPrimaries, Config, Context, EncoderConfig, EncoderStatus,
    FrameType, MatrixCoefficients, PixelRange, Rational, SpeedSettings, TransferCharacteristics,
};

use super::{Canvas, FilmError};

/// How coarsely is quantised, from 0 to 255: at 80 letters of 8 pixels stay sharp.
const QUANTIZER: usize = 80;
/// The fastest preset of the encoder.
const SPEED: u8 = 10;
/// A film can be entered at every so many pictures.
const KEY_FRAMES: u64 = 60;
/// What an OBU stream separates pictures by, and a file in MP4 must not (AV1 Codec ISO Media File Format Binding, 2.4).
const TEMPORAL_DELIMITER: [u8; 2] = [0x12, 0x00];

/// A video in the making.
pub struct Video {
    seconds: f64,
    size: [usize; 2],
    encoder: Context<u8>,
    muxer: Muxer<BufWriter<File>>,
}

impl Video {
    /// A video of pictures as large as this one, that many seconds a picture.
    ///
    /// # Errors
    /// A size that the encoder refuses, or a file that cannot be made.
    pub(super) fn begin(path: &Path, seconds: f64, first: &Canvas) -> Result<Self, FilmError> {
        let (width, height) = (first.width, first.height);
        let config = EncoderConfig {
            width,
            height,
            time_base: Rational::new((seconds * 1e6).round() as u64, 1_000_000),
            chroma_sampling: ChromaSampling::Cs420,
            pixel_range: PixelRange::Limited,
            color_description: Some(ColorDescription {
                color_primaries: ColorPrimaries::BT709,
                transfer_characteristics: TransferCharacteristics::BT709,
                matrix_coefficients: MatrixCoefficients::BT709,
            }),
            low_latency: true,
            quantizer: QUANTIZER,
            min_key_frame_interval: 0,
            max_key_frame_interval: KEY_FRAMES,
            // Parts of a picture that are encoded side by side; their number changes the bytes, so it is fixed.
            tiles: 4,
            speed_settings: SpeedSettings::from_preset(SPEED),
            ..EncoderConfig::default()
        };
        let encoder =
            Config::new().with_encoder_config(config).new_context().map_err(|error| fault(&error))?;
        let file = File::create(path).map_err(|source| FilmError::File { path: path.to_owned(), source })?;
        let muxer = MuxerBuilder::new(BufWriter::new(file))
            .video(VideoCodec::Av1, width as u32, height as u32, 1.0 / seconds)
            .build()
            .map_err(|error| fault(&error))?;
        Ok(Self { seconds, size: [width, height], encoder, muxer })
    }

    /// Takes a picture.
    ///
    /// # Errors
    /// A picture of another size than the first, or a file that cannot be written.
    pub(super) fn take(&mut self, canvas: &Canvas) -> Result<(), FilmError> {
        if self.size != [canvas.width, canvas.height] {
            let [width, height] = self.size;
            return Err(FilmError::Video {
                reason: format!("a picture has another size than the first, {width} x {height}"),
            });
        }
        let mut frame = self.encoder.new_frame();
        let across = canvas.width.div_ceil(2);
        for ((plane, samples), stride) in
            frame.planes.iter_mut().zip(&planes(canvas)).zip([canvas.width, across, across])
        {
            plane.copy_from_raw_u8(samples, stride, 1);
        }
        self.encoder.send_frame(frame).map_err(|error| fault(&error))?;
        self.write()
    }

    /// Ends the video.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub(super) fn finish(mut self) -> Result<(), FilmError> {
        self.encoder.flush();
        self.write()?;
        self.muxer.finish().map_err(|error| fault(&error))
    }

    /// Writes what the encoder has ready.
    fn write(&mut self) -> Result<(), FilmError> {
        loop {
            match self.encoder.receive_packet() {
                Ok(packet) => {
                    let at = packet.input_frameno as f64 * self.seconds;
                    let data = packet.data.strip_prefix(&TEMPORAL_DELIMITER).unwrap_or(&packet.data);
                    let is_key = packet.frame_type == FrameType::KEY;
                    self.muxer.write_video(at, data, is_key).map_err(|error| fault(&error))?;
                }
                Err(EncoderStatus::Encoded) => {}
                Err(EncoderStatus::NeedMoreData | EncoderStatus::LimitReached) => return Ok(()),
                Err(error) => return Err(fault(&error)),
            }
        }
    }
}

fn fault(error: &dyn std::fmt::Display) -> FilmError {
    FilmError::Video { reason: error.to_string() }
}

/// Luma and two chroma planes of half the size each way, in 16 to 235 and 16 to 240 (ITU-R BT.709, 3.4 and 3.5).
fn planes(canvas: &Canvas) -> [Vec<u8>; 3] {
    let (width, height) = (canvas.width, canvas.height);
    let weights = [0.2126_f32, 0.7152, 0.0722];
    let luma_of =
        |rgb: [f32; 3]| weights.iter().zip(rgb).map(|(weight, channel)| weight * channel).sum::<f32>();
    let pixel = |x: usize, y: usize| -> [f32; 3] {
        let at = 3 * (y.min(height - 1) * width + x.min(width - 1));
        [0, 1, 2].map(|channel| f32::from(canvas.rgb[at + channel]) / 255.0)
    };
    let luma = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let luma = luma.map(|(x, y)| (16.0 + 219.0 * luma_of(pixel(x, y))).round() as u8).collect();
    let (mut blue, mut red) = (Vec::new(), Vec::new());
    for (x, y) in (0..height).step_by(2).flat_map(|y| (0..width).step_by(2).map(move |x| (x, y))) {
        let four = [pixel(x, y), pixel(x + 1, y), pixel(x, y + 1), pixel(x + 1, y + 1)];
        let mean = [0, 1, 2].map(|channel| four.iter().map(|rgb| rgb[channel]).sum::<f32>() / 4.0);
        let luma = luma_of(mean);
        blue.push((128.0 + 224.0 * (mean[2] - luma) / 1.8556).round() as u8);
        red.push((128.0 + 224.0 * (mean[0] - luma) / 1.5748).round() as u8);
    }
    [luma, blue, red]
}

#[cfg(test)]
mod tests {
    use super::super::Film;
    use super::*;

    #[test]
    fn colours_are_those_of_the_standard() {
        let mut canvas = Canvas::default();
        canvas.load(2, 2, &[255, 0, 0].repeat(4));
        // 100 % red bars have these codes (ITU-R BT.709, 8 bits).
        assert_eq!(planes(&canvas), [vec![63; 4], vec![102], vec![240]]);
        canvas.load(3, 1, &[255; 9]);
        assert_eq!(planes(&canvas), [vec![235; 3], vec![128; 2], vec![128; 2]]);
    }

    /// A reader of another hand finds the pictures, their times and their size in the file.
    #[test]
    fn a_video_is_read_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("film.mp4");
        let mut film = Film::mp4(&path, 0.04);
        let mut canvas = Canvas::default();
        for shade in 0..7_u8 {
            // An odd width, and a picture that changes.
            canvas.load(65, 48, &[]);
            canvas.rgb.fill(30 * shade);
            canvas.text([4 + i64::from(shade), 8], "simworld", [255, 40, 40], 1);
            film.take(&canvas).unwrap();
        }
        canvas.load(64, 64, &[]);
        assert!(film.take(&canvas).unwrap_err().to_string().contains("65 x 48"));
        film.finish().unwrap();
        let file = re_mp4::Mp4::read_bytes(&std::fs::read(&path).unwrap()).unwrap();
        let track = file.tracks().values().next().unwrap();
        assert_eq!((track.width, track.height, track.samples.len()), (65, 48, 7));
        assert!(track.codec_string(&file).is_some_and(|codec| codec.starts_with("av01")));
        assert!(track.samples[0].is_sync && !track.samples[1].is_sync);
        let step = track.timescale as f64 * 0.04;
        for (index, sample) in track.samples.iter().enumerate() {
            assert!((sample.composition_timestamp as f64 - step * index as f64).abs() < 1.0, "{index}");
            assert!(sample.size > 8, "{index}: {} bytes", sample.size);
        }
        let tiny = folder.path().join("tiny.mp4");
        canvas.load(4, 4, &[]);
        assert!(Film::mp4(&tiny, 0.04).take(&canvas).is_err(), "the encoder needs 16 pixels each way");
    }
}
