//! A device without memory is an error with a type, and nothing else ends: not the process, not the simulation, not the renderer.
#![cfg(target_os = "linux")]

use std::process::Command;

use crate::common::{draw, renderer, square, square_camera};
use simworld_core::scene::Scene;
use simworld_render::{Frame, RenderConfig, RenderError, ViewOptions, ViewRequest, Views};

/// Set in the process that this test starts.
const ALONE: &str = "SIMWORLD_TEST_SHORT_OF_MEMORY";
/// What that process may take beyond what it has, bytes: enough for what small pictures need anew, and less than one plane of the large
/// one.
const SPARE: u64 = 124 << 20;

/// Bounds the address space of this process to what it has and a little more.
fn bound_memory() {
    let status = std::fs::read_to_string("/proc/self/status").expect("Linux tells");
    let kib = status.lines().find_map(|line| line.strip_prefix("VmSize:")?.trim().strip_suffix(" kB"));
    let bytes = kib.and_then(|kib| kib.trim().parse::<u64>().ok()).expect("a number") * 1024 + SPARE;
    let pid = std::process::id().to_string();
    let done = Command::new("prlimit").args(["--pid", &pid, &format!("--as={bytes}")]).status();
    assert!(done.expect("prlimit is there").success());
}

/// On software Vulkan the memory of the device is that of the process. The test starts itself again, since others would lack the memory
/// too.
#[test]
fn without_memory_there_is_an_error_and_then_the_next_picture() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    if !renderer.adapter().contains("llvmpipe") {
        println!("skipped: how much memory {} has cannot be bounded", renderer.adapter());
        return;
    }
    if std::env::var_os(ALONE).is_none() {
        let mut again = Command::new(std::env::current_exe().expect("the test has a file"));
        again.args([
            "--exact",
            "memory_runs_out::without_memory_there_is_an_error_and_then_the_next_picture",
            "--nocapture",
        ]);
        // Traces take more memory than there is.
        let output = again.env(ALONE, "1").env("RUST_BACKTRACE", "0").output().expect("it starts");
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
        assert!(said.contains("out of memory, and on"), "{said}");
        return;
    }
    let (mut world, small) = (square(0.0), square_camera(0.0, 160, 120));
    let expected = draw(&mut renderer, &world, &small);
    let ticket = renderer.submit(&world, &[small.into()], &ViewOptions::default()).expect("handed in");
    bound_memory();
    let large = ViewRequest::from(square_camera(0.0, 5700, 5700));
    for _ in 0..2 {
        let outcome = renderer.render_views(&world, &[large], &ViewOptions::default(), &mut Views::new());
        assert!(matches!(outcome, Err(RenderError::OutOfMemory)), "{outcome:?}");
        assert!(outcome.is_err_and(|error| error.to_string().contains("draw a smaller picture")));
        // The simulation does not know of it, and the renderer draws what it drew.
        let tick = world.clock().tick().0;
        world.begin_step();
        world.finish_step();
        assert_eq!(world.clock().tick().0, tick + 1);
        let mut frame = Frame::new();
        renderer.render(&world, &small, &mut frame).expect("a small picture has its memory");
        assert!(frame.depth == expected.depth && frame.ids == expected.ids, "another picture");
    }
    let mut views = Views::new();
    renderer.take(ticket, &mut views).expect("what was under way is still there");
    assert!(views.depth == expected.depth, "another picture");
    println!("out of memory, and on");
}
