// Lamps near the eye, in a grid of cells on the ground: each cell names the few that reach it. The twin of lamps.rs.
const CELLS_ACROSS: u32 = 32u;
const CELL: f32 = 8.0;
const LAMPS_A_CELL: u32 = 8u;

// A lamp sends `color` (exposed candela times π) towards `aim` within a cone, the less the farther off its axis.
fn lamp_light(s: Surface, point: vec3f, view: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    let local = point - globals.lamp_grid.xyz;
    let base = u32(globals.lamp_grid.w);
    let spot = local.xy / CELL;
    let inside = all(spot >= vec2f(0.0)) && all(spot < vec2f(f32(CELLS_ACROSS)));
    let cell = base + 2u * (u32(max(spot.y, 0.0)) * CELLS_ACROSS + u32(max(spot.x, 0.0)));
    // Loops that never run cost nothing on a CPU, where branches do.
    let count = select(0u, LAMPS_A_CELL, inside && base > 0u);
    for (var k = 0u; k < count; k++) {
        let index = lights[cell + (k >> 2u)][k & 3u];
        if (index < 0.0) {
            break;
        }
        let at = base + 2u * CELLS_ACROSS * CELLS_ACROSS + 3u * u32(index);
        let place = lights[at];
        let color = lights[at + 1u];
        let aim = lights[at + 2u];
        let towards = place.xyz - local;
        let square = dot(towards, towards);
        let direction = towards * inverseSqrt(max(square, 1e-4));
        // Falls smoothly to nothing at its range.
        let share = saturate(1.0 - square * square * place.w);
        let cone = smoothstep(color.w, aim.w, -dot(direction, aim.xyz));
        let strength = share * share * cone / max(square, 0.25);
        sum += reflected(s, view, direction) * color.rgb * strength;
    }
    return sum;
}
