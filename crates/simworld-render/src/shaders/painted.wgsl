// Paints whatever a view ray meets, of any pattern.
fn painted(hit: Hit, base: Surface) -> Surface {
    switch hit.pattern {
        case 1u: { return facade(hit, base); }
        case 2u: { return road(hit, base); }
        case 3u: { return sidewalk(hit, base); }
        case 4u: { return crosswalk(hit, base); }
        case 5u: { return ground(hit, base); }
        case 6u: { return foliage(hit, base); }
        case 7u: { return marked(hit, base); }
        default: { return base; }
    }
}
