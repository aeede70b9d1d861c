# Short names for the commands of daily work; `just` lists them.

default:
    @just --list

# Software Vulkan, so that the renderer runs without a GPU (Debian, as root).
setup:
    apt-get install -y mesa-vulkan-drivers libvulkan1

# llama.cpp for the tests of models: then SIMWORLD_MODEL_SERVER=target/model-server just test
model-server:
    ci/model-server

# What CI checks before it tests: format, lints, docs, dependency direction.
check:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps
    ci/check-dependencies

# All tests, as in the README.
test:
    cargo test --workspace

# The tests that take longer than seconds, whole; write what they print to docs/soak.md.
soak:
    SIMWORLD_SOAK=1 cargo test --release --workspace -- --nocapture

# Every figure that the project claims.
bench:
    cargo bench --workspace
    cargo run --release --example figures

# A city in a window.
view:
    cargo run --release --example view --features window -- --window

# The main job, with its pictures.
look:
    cargo run --release --example delivery -- --out out/look

# Everything CI does.
ci:
    .ci/run
