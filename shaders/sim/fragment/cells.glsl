// The cell of x, counted as sim/cpu/grid.c does; clamped, so that a position that is not finite does no harm before it
// is reported. Cell c is texel (c mod width, c / width), of a width of 2^bucket_bits, of each layer of the buckets.
ivec3 cell_of(vec3 x)
{
    ivec3 first = cell_first + 1, last = cell_first + cell_size - 2;
    return clamp(ivec3(floor(x * kernel.y)), first, last) - first + 1;
}

int cell_index(ivec3 at) { return (at.z * cell_size.y + at.y) * cell_size.x + at.x; }

ivec2 bucket_of(int cell) { return ivec2(cell & (1 << bucket_bits) - 1, cell >> bucket_bits); }
