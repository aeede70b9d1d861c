// From four bytes a pixel and channel to what was asked for, four pixels a call. Rows are padded, so that no four pixels are of two rows.
struct Packing {
    // How many groups of four pixels there are, and how many of them a row of workgroups has.
    quads: u32,
    row: u32,
    // Which channels are wanted, as bits: colour, depth, ids, classes.
    wanted: u32,
    // Whether depth is wanted in millimetres of 16 bits, and classes in 16 bits.
    compact: u32,
}

@group(0) @binding(0) var<uniform> packing: Packing;
@group(0) @binding(1) var<storage, read> color: array<u32>;
@group(0) @binding(2) var<storage, read> depth: array<u32>;
@group(0) @binding(3) var<storage, read> who: array<u32>;
@group(0) @binding(4) var<storage, read_write> out_rgb: array<u32>;
@group(0) @binding(5) var<storage, read_write> out_depth: array<u32>;
@group(0) @binding(6) var<storage, read_write> out_ids: array<u32>;
@group(0) @binding(7) var<storage, read_write> out_classes: array<u32>;

const SKY_CLASS: u32 = 23u;

// As in 16-bit PNG: 0 for the sky, 65535 from 65.535 m on.
fn millimetres(bits: u32, id: u32) -> u32 {
    let rounded = u32(clamp(bitcast<f32>(bits) * 1000.0 + 0.5, 1.0, 65535.0));
    return select(rounded, 0u, id == 0u);
}

fn class_of(id: u32) -> u32 {
    return select(id >> 24u, SKY_CLASS, id == 0u);
}

@compute @workgroup_size(64)
fn pack(@builtin(global_invocation_id) at: vec3u) {
    let quad = at.y * packing.row + at.x;
    if (at.x >= packing.row || quad >= packing.quads) {
        return;
    }
    let first = quad * 4u;
    if ((packing.wanted & 1u) != 0u) {
        let a = color[first];
        let b = color[first + 1u];
        let c = color[first + 2u];
        let d = color[first + 3u];
        out_rgb[quad * 3u] = (a & 0xffffffu) | (b << 24u);
        out_rgb[quad * 3u + 1u] = ((b >> 8u) & 0xffffu) | (c << 16u);
        out_rgb[quad * 3u + 2u] = ((c >> 16u) & 0xffu) | (d << 8u);
    }
    if ((packing.wanted & 14u) == 0u) {
        return;
    }
    var ids = vec4u(who[first], who[first + 1u], who[first + 2u], who[first + 3u]);
    if ((packing.wanted & 2u) != 0u) {
        var bits = vec4u(depth[first], depth[first + 1u], depth[first + 2u], depth[first + 3u]);
        if (packing.compact != 0u) {
            for (var k = 0; k < 4; k++) {
                bits[k] = millimetres(bits[k], ids[k]);
            }
            out_depth[quad * 2u] = bits.x | (bits.y << 16u);
            out_depth[quad * 2u + 1u] = bits.z | (bits.w << 16u);
        } else {
            // Infinity where there is nothing.
            bits = select(bits, vec4u(0x7f800000u), ids == vec4u(0u));
            out_depth[first] = bits.x;
            out_depth[first + 1u] = bits.y;
            out_depth[first + 2u] = bits.z;
            out_depth[first + 3u] = bits.w;
        }
    }
    if ((packing.wanted & 4u) != 0u) {
        out_ids[first] = ids.x & 0xffffffu;
        out_ids[first + 1u] = ids.y & 0xffffffu;
        out_ids[first + 2u] = ids.z & 0xffffffu;
        out_ids[first + 3u] = ids.w & 0xffffffu;
    }
    if ((packing.wanted & 8u) != 0u) {
        let c = vec4u(class_of(ids.x), class_of(ids.y), class_of(ids.z), class_of(ids.w));
        if (packing.compact != 0u) {
            out_classes[quad * 2u] = c.x | (c.y << 16u);
            out_classes[quad * 2u + 1u] = c.z | (c.w << 16u);
        } else {
            out_classes[quad] = c.x | (c.y << 8u) | (c.z << 16u) | (c.w << 24u);
        }
    }
}
