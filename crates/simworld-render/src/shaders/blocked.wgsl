// Whether anything is on a ray: the walk of rays.wgsl, in any order, up to the first triangle that is met.

// The code of a child that the ray comes into, while the others are put aside; NOTHING if it comes into none.
fn descend_anywhere(node: u32, entries: vec4f, codes: vec4u, height: ptr<function, u32>) -> u32 {
    let bits = select(vec4u(0u), vec4u(1u, 2u, 4u, 8u), entries < vec4f(1e30));
    let children = bits.x | bits.y | bits.z | bits.w;
    if (children == 0u) {
        return NOTHING;
    }
    let others = children & (children - 1u);
    if (others != 0u) {
        open[*height] = node << 4u | others;
        *height += 1u;
    }
    return one_of(codes, firstTrailingBit(children));
}

// A child that was put aside above `base`, as four times its node plus which of its children it is; NOTHING if there is none.
fn next_anywhere(height: ptr<function, u32>, base: u32) -> u32 {
    if (*height == base) {
        return NOTHING;
    }
    let top = open[*height - 1u];
    let others = top & (top - 1u);
    if ((others & 15u) == 0u) {
        *height -= 1u;
    } else {
        open[*height - 1u] = others;
    }
    return (top >> 4u) << 2u | firstTrailingBit(top);
}

// Whether a ray meets a triangle of a leaf; where its origin is from the eye, and where it goes in the world, decides how blurred pictures are seen.
fn is_in_leaf(ray: Ray, code: u32, number: u32, scale: vec3f, unit: f32, start: f32, origin: vec3f, direction: vec3f) -> bool {
    let run = triangles_of(code);
    for (var k = 0u; k < run.x; k++) {
        let at = run.y + k * 5u;
        let one = triangle_at(at, scale, unit);
        let t = meet_triangle(ray, one);
        if (t >= start) {
            if ((FEATURES & WITH_CUTS) != 0u && (pieces[at + 4u].w & IS_CUT) != 0u
                && shines_through(ray, t, one, at, number, length(origin + direction * t))) {
                continue;
            }
            return true;
        }
    }
    return false;
}

// Whether a ray meets the mesh of an instance; the origin is relative to the eye.
fn is_in_mesh(number: u32, root: u32, origin: vec3f, direction: vec3f, start: f32, base: u32) -> bool {
    let ray = body_ray(number, origin, direction);
    let scale = instances[number].scale.xyz;
    let unit = instances[number].place.w;
    var height = base;
    var code = root;
    loop {
        if ((code & IS_LEAF) == 0u) {
            let entries = enter_four(sides_in_mesh(ray, scale, unit, code), start * 0.999, FAR_AWAY);
            code = descend_anywhere(code, entries, pieces[code], &height);
        } else {
            if (is_in_leaf(ray, code, number, scale, unit, start, origin, direction)) {
                return true;
            }
            code = NOTHING;
        }
        if (code == NOTHING) {
            let next = next_anywhere(&height, base);
            if (next == NOTHING) {
                return false;
            }
            code = code_in_mesh(next);
        }
    }
    return false;
}

// Whether a ray meets an entity, at the level of detail at which it is seen from the eye.
fn is_in_entity(leader: u32, world: Ray, origin: vec3f, start: f32, base: u32) -> bool {
    if ((placed[leader].order & NO_SHADOW) != 0u) {
        return false;
    }
    let sighting = sighting_of(leader);
    let level = level_in(sighting);
    var number = placed[leader].first[level];
    while (number != NOTHING) {
        if (enters(world, placed[number].low, placed[number].high, start * 0.999, FAR_AWAY)
            && is_in_mesh(number, root_of(number, sighting), origin, world.direction, start, base)) {
            return true;
        }
        number = placed[number].next[level];
    }
    return false;
}

// Whether something that throws shadows is on a ray; its origin is relative to the eye.
fn is_blocked(origin: vec3f, direction: vec3f, start: f32) -> bool {
    let ray = ray_of(eye + origin, direction);
    var rest = views[view].hidden.y;
    var height = 0u;
    var code = 0u;
    loop {
        if ((code & IS_LEAF) == 0u) {
            let at = code * 7u;
            let entries = enter_four(sides_in_tree(ray, at), start * 0.999, FAR_AWAY);
            code = descend_anywhere(code, entries, bitcast<vec4u>(tree[at]), &height);
        } else {
            if (is_in_entity(code & ~IS_LEAF, ray, origin, start, height)) {
                return true;
            }
            code = NOTHING;
        }
        if (code == NOTHING) {
            let next = next_anywhere(&height, 0u);
            if (next != NOTHING) {
                code = code_in_tree(next);
            } else if (rest != NOTHING) {
                code = rest;
                rest = NOTHING;
            } else {
                return false;
            }
        }
    }
    return false;
}
