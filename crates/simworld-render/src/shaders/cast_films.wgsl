// What is blended, by rays: the nearest surface of a layer of it is laid over what was painted, first of what counts, which is who is there then, and over what falls of what is
// thinner, which changes colour alone until all is done.
@compute @workgroup_size(8, 8)
fn glaze(@builtin(global_invocation_id) at: vec3u) {
    let pixel = pixel_of(at);
    if (pixel == NOTHING) {
        return;
    }
    look(at.z);
    globals = views[at.z].globals;
    // Parallel rays end at the far plane.
    let behind = select(select(FAR_AWAY * 0.1, limits.x, parallel), out_depth[pixel], out_who[pixel] != 0u);
    let sight = sight_along(optical_ray(at.xy));
    let found = trace(sight.origin, sight.direction, views[view].eye.w, behind);
    if (found.number == NOTHING) {
        return;
    }
    let met = met_at(found.number, found.triangle, sight.origin + sight.direction * found.t);
    lit = f32(is_lit(met));
    let color = shade(hit_of(met, found.number, found.triangle, sight.direction));
    out_color[pixel] = encoded(mix(decoded(out_color[pixel]), color, there));
    if (FILMS == COUNTED_FILMS) {
        out_depth[pixel] = found.t;
        out_who[pixel] = instances[found.number].who;
    }
}
