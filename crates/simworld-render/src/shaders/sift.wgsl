// Who of all instances is drawn in one view, and where: listed by mesh and distance as the host lists them, in the order of entities and parts where
// these are the same. Places follow from sums over those before, so that they are always the same.
//
// `sift`: what each instance is in the view, and how many each group lets through; `scan`: sums of these; `gather`: those that come through, one behind the
// other. Then twice or four times `tally`, `scan` and `deal`, which sort them by the next eight bits of their keys. At last `copy` lays the instances out
// as they are drawn, and `tell` says how many there are of each kind.

// The twin of `Sieve` in sieve.rs, where its units are told.
struct Sieve {
    eye: vec3i,
    flags: u32,
    sides: array<vec4i, 5>,
    reach: array<vec4f, 4>,
    far: u32,
    hidden: u32,
    only: u32,
    count: u32,
}

// What is known of an instance; the twin of `Token` in deck.rs.
struct Card {
    center: vec3i,
    radius: u32,
    size: f32,
    slot: u32,
    kind: u32,
    // The levels of detail at which it is there, and from bit 3 whether it throws shadows.
    traits: u32,
}

// A mesh or a model; the twin of `Kind` in deck.rs.
struct Kind {
    // What stands for it below a threshold.
    speck: u32,
    threshold: u32,
    is_flat: u32,
    spare: u32,
    // First corner and count: of what is whole, of what is cut out, and of what is blended.
    whole: vec2u,
    cut: vec2u,
    film: vec2u,
}

@group(0) @binding(0) var<uniform> sieve: Sieve;
@group(0) @binding(1) var<storage, read> cards: array<Card>;
// The numbers of instances by entity and part.
@group(0) @binding(2) var<storage, read> order: array<u32>;
@group(0) @binding(3) var<storage, read> kinds: array<Kind>;
// Six to an instance.
@group(0) @binding(4) var<storage, read> instances: array<vec4u>;
// Keys and numbers; the second half is for those that are on their way.
@group(0) @binding(5) var<storage, read_write> entries: array<vec2u>;
// How many come through, then what is summed up.
@group(0) @binding(6) var<storage, read_write> sums: array<u32>;
@group(0) @binding(7) var<storage, read_write> drawn: array<vec4u>;
// Five numbers to a draw: of every kind what is whole, then of every kind what is cut out, then what is blended.
@group(0) @binding(8) var<storage, read_write> draws: array<u32>;
// How many groups look at those that come through.
@group(1) @binding(0) var<storage, read_write> groups: array<u32>;

// Which eight bits of the keys are looked at, from the lowest on.
override DIGIT: u32 = 0u;
// Whether the sums are those of digits, and not of those that come through.
override DIGITS: bool = false;

const WIDE: u32 = 256u;
const NOBODY: u32 = 0xffffffffu;
const PARALLEL: u32 = 1u;
const CASTERS: u32 = 2u;
const CASTS: u32 = 8u;
const NO_SPECK: u32 = 15u;
const BUCKETS: u32 = 64u;
const SLACK: u32 = 10u;
// 8.5 m in steps.
const LARGE: f32 = 544.0;

var<workgroup> shelf: array<u32, 256>;
var<workgroup> tallies: array<atomic<u32>, 256>;
// How many are at hand.
var<workgroup> total: u32;

fn groups_of(count: u32) -> u32 {
    return (count + WIDE - 1u) / WIDE;
}

// How many come through; the same for all of a group.
fn listed(lane: u32) -> u32 {
    if (lane == 0u) {
        total = sums[0];
    }
    return workgroupUniformLoad(&total);
}

// The sum over the lanes before.
fn before(lane: u32, value: u32) -> u32 {
    shelf[lane] = value;
    workgroupBarrier();
    for (var step = 1u; step < WIDE; step *= 2u) {
        var more = 0u;
        if (lane >= step) {
            more = shelf[lane - step];
        }
        workgroupBarrier();
        shelf[lane] += more;
        workgroupBarrier();
    }
    return shelf[lane] - value;
}

fn root(square: u32) -> u32 {
    var root = u32(sqrt(f32(square)));
    while (root * root > square) {
        root -= 1u;
    }
    while ((root + 1u) * (root + 1u) <= square) {
        root += 1u;
    }
    return root;
}

// Steps to the middle of a ball; NOBODY if it is beside what is seen, or beyond.
fn distance_of(card: Card) -> u32 {
    let away = card.center - sieve.eye;
    let parts = vec3u(abs(away));
    let most = max(max(parts.x, parts.y), max(parts.z, card.radius));
    let bits = 32u - countLeadingZeros(most);
    let shift = select(0u, bits - 15u, bits > 15u);
    let near = away >> vec3u(shift);
    let reach = (card.radius >> shift) + 1u + SLACK;
    for (var k = 0; k < 5; k++) {
        let side = sieve.sides[k];
        let inside = side.x * near.x + side.y * near.y + side.z * near.z;
        if ((inside >> 14u) + (side.w >> shift) + i32(reach) < 0) {
            return NOBODY;
        }
    }
    let squares = vec3u(near * near);
    let distance = root(squares.x + squares.y + squares.z);
    if (distance > (sieve.far >> shift) + reach) {
        return NOBODY;
    }
    return distance << shift;
}

// Whether a ball that is so far away reaches a threshold of pixels.
fn has(threshold: u32, size: f32, apart: f32) -> bool {
    return size * sieve.reach[threshold / 4u][threshold % 4u] >= apart;
}

fn bucket(distance: u32) -> u32 {
    let shown = max(distance, 32u);
    let octave = 31u - countLeadingZeros(shown);
    return min((octave - 5u) * 4u + ((shown >> (octave - 2u)) & 3u), BUCKETS - 1u);
}

// Kind and bucket of an instance as it is drawn; NOBODY if it is not.
fn key_of(card: Card) -> u32 {
    var may_be = card.slot != sieve.hidden && (sieve.only == NOBODY || sieve.only == card.slot);
    if ((sieve.flags & CASTERS) != 0u) {
        may_be = (card.traits & CASTS) != 0u;
    }
    if (!may_be) {
        return NOBODY;
    }
    let distance = distance_of(card);
    if (distance == NOBODY) {
        return NOBODY;
    }
    let apart = select(1.0, max(f32(distance), card.size), (sieve.flags & PARALLEL) == 0u);
    let first = select(1u, 3u, card.size > LARGE);
    let middle = has(first, card.size, apart);
    let level = select(1u, select(2u, 4u, has(first + 1u, card.size, apart)), middle);
    if (!has(0u, card.size, apart) || (card.traits & level) == 0u) {
        return NOBODY;
    }
    var kind = card.kind;
    let threshold = kinds[kind].threshold;
    if (threshold != NO_SPECK && !has(threshold, card.size, apart)) {
        kind = kinds[kind].speck;
    }
    return kind * BUCKETS + select(bucket(distance), 0u, kinds[kind].is_flat != 0u);
}

@compute @workgroup_size(256)
fn sift(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let place = group.x * WIDE + lane;
    var entry = vec2u(NOBODY);
    if (place < sieve.count) {
        let number = order[place];
        entry = vec2u(key_of(cards[number]), number);
        entries[sieve.count + place] = entry;
    }
    if (lane == 0u) {
        atomicStore(&tallies[0], 0u);
    }
    workgroupBarrier();
    if (entry.x != NOBODY) {
        atomicAdd(&tallies[0], 1u);
    }
    workgroupBarrier();
    if (lane == 0u) {
        sums[1u + group.x] = atomicLoad(&tallies[0]);
    }
}

// Each sum becomes that of all before it.
@compute @workgroup_size(256)
fn scan(@builtin(local_invocation_index) lane: u32) {
    let found = listed(lane);
    let count = select(groups_of(sieve.count), WIDE * groups_of(found), DIGITS);
    let each = (count + WIDE - 1u) / WIDE;
    let first = min(lane * each, count);
    let last = min(first + each, count);
    var own = 0u;
    for (var k = first; k < last; k++) {
        own += sums[1u + k];
    }
    var sum = before(lane, own);
    if (!DIGITS && lane == WIDE - 1u) {
        sums[0] = sum + own;
        groups[0] = groups_of(sum + own);
        groups[1] = 1u;
        groups[2] = 1u;
    }
    for (var k = first; k < last; k++) {
        let one = sums[1u + k];
        sums[1u + k] = sum;
        sum += one;
    }
}

@compute @workgroup_size(256)
fn gather(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    if (lane == 0u) {
        let is_last = group.x + 1u == groups_of(sieve.count);
        total = select(sums[2u + group.x], sums[0], is_last) - sums[1u + group.x];
    }
    // Most groups let nobody through.
    if (workgroupUniformLoad(&total) == 0u) {
        return;
    }
    let place = group.x * WIDE + lane;
    var entry = vec2u(NOBODY);
    if (place < sieve.count) {
        entry = entries[sieve.count + place];
    }
    let earlier = before(lane, u32(entry.x != NOBODY));
    if (entry.x != NOBODY) {
        entries[sums[1u + group.x] + earlier] = entry;
    }
}

fn digit_of(key: u32) -> u32 {
    return (key >> (8u * DIGIT)) & 255u;
}

// Where the entries are before a digit is sorted; they go to the other half.
fn from_here() -> u32 {
    return select(0u, sieve.count, (DIGIT & 1u) != 0u);
}

// How often each digit is there in a group, group by group for each digit.
@compute @workgroup_size(256)
fn tally(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let found = sums[0];
    atomicStore(&tallies[lane], 0u);
    workgroupBarrier();
    let place = group.x * WIDE + lane;
    if (place < found) {
        atomicAdd(&tallies[digit_of(entries[from_here() + place].x)], 1u);
    }
    workgroupBarrier();
    sums[1u + lane * groups_of(found) + group.x] = atomicLoad(&tallies[lane]);
}

@compute @workgroup_size(256)
fn deal(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let found = sums[0];
    let place = group.x * WIDE + lane;
    var entry = vec2u(0u);
    shelf[lane] = WIDE;
    if (place < found) {
        entry = entries[from_here() + place];
        shelf[lane] = digit_of(entry.x);
    }
    workgroupBarrier();
    if (place < found) {
        let digit = shelf[lane];
        var earlier = 0u;
        for (var k = 0u; k < lane; k++) {
            earlier += u32(shelf[k] == digit);
        }
        entries[sieve.count - from_here() + sums[1u + digit * groups_of(found) + group.x] + earlier] = entry;
    }
}

@compute @workgroup_size(256)
fn copy(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let place = group.x * WIDE + lane;
    if (place >= sums[0]) {
        return;
    }
    let number = entries[place].y;
    for (var k = 0u; k < 6u; k++) {
        drawn[place * 6u + k] = instances[number * 6u + k];
    }
}

// The first place whose key is no less.
fn first_of(key: u32) -> u32 {
    var low = 0u;
    var high = sums[0];
    while (low < high) {
        let middle = (low + high) / 2u;
        if (entries[middle].x < key) {
            low = middle + 1u;
        } else {
            high = middle;
        }
    }
    return low;
}

fn draw(index: u32, corners: vec2u, first: u32, count: u32) {
    draws[index * 5u] = corners.y;
    draws[index * 5u + 1u] = count;
    draws[index * 5u + 2u] = corners.x;
    draws[index * 5u + 3u] = 0u;
    draws[index * 5u + 4u] = first;
}

@compute @workgroup_size(256)
fn tell(@builtin(global_invocation_id) at: vec3u) {
    let kind = at.x;
    let count = arrayLength(&kinds);
    if (kind >= count) {
        return;
    }
    let first = first_of(kind * BUCKETS);
    let many = first_of((kind + 1u) * BUCKETS) - first;
    draw(kind, kinds[kind].whole, first, many);
    draw(count + kind, kinds[kind].cut, first, many);
    draw(2u * count + kind, kinds[kind].film, first, many);
}
