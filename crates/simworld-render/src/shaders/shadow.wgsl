// The sun's view: depth alone.
@vertex
fn vertex_shadow(in: VertexIn) -> @builtin(position) vec4f {
    return globals.shadow_from_relative * vec4f(relative_point(in), 1.0);
}
