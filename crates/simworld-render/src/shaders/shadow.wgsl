// The sun's view: depth alone.
@vertex
fn vertex_shadow(corner: Corner) -> @builtin(position) vec4f {
    let in = vertex_of(corner);
    return globals.shadow_from_relative * vec4f(relative_point(in), 1.0);
}
