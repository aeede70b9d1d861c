// Rain and snow by triangles: drawn over the picture where nothing is nearer; depth and ids are left alone.
struct Drop {
    @builtin(position) position: vec4f,
    @location(0) across: vec2f,
    @location(1) @interpolate(flat) strength: f32,
}

@vertex
fn vertex_drop(@builtin(vertex_index) corner: u32, @builtin(instance_index) index: u32) -> Drop {
    let streak = streak_of(index);
    // Two triangles: corners 0 1 2 and 2 1 3.
    let which = select(corner, select(select(3u, 1u, corner == 4u), 2u, corner == 3u), corner > 2u);
    let side = f32(which & 1u) * 2.0 - 1.0;
    let end = f32(which >> 1u) * 2.0 - 1.0;
    let place = streak.middle + streak.wide * (side * streak.half_width) + streak.axis * (end * streak.half_length);
    var out: Drop;
    out.position = globals.clip_from_relative * vec4f(place, 1.0);
    out.across = vec2f(side, end);
    out.strength = streak.strength;
    return out;
}

fn drop_color(in: Drop) -> vec4f {
    return vec4f(streak_color(), cover_of(in.across, in.strength));
}

@fragment
fn fragment_drop(in: Drop) -> @location(0) vec4f {
    return drop_color(in);
}

struct DropAll {
    @location(0) color: vec4f,
    @location(1) depth: f32,
    @location(2) id: u32,
}

// Depth and ids are masked.
@fragment
fn fragment_drop_all(in: Drop) -> DropAll {
    return DropAll(drop_color(in), 0.0, 0u);
}
