// The cell of x, counted as sim/cpu/grid.c does; clamped, so that a position that is not finite does no harm before it
// is reported. Cell c is texel (c mod width, c / width), of a width of 2^bucket_bits, of each layer of the buckets.
ivec3 cell_of(vec3 x)
{
    ivec3 first = first_cell + 1, last = first_cell + grid_size - 2;
    return clamp(ivec3(floor(x * inverse_support)), first, last) - first + 1;
}

int cell_index(ivec3 at) { return (at.z * grid_size.y + at.y) * grid_size.x + at.x; }

// The k-th of four places. NVIDIA's compiler (580) let empty places pass a loop `k < 4 && four[k] != 0u`: no component by a
// number, and the test stands inside.
uint place_of(uvec4 four, int k) { return k < 2 ? (k == 0 ? four.x : four.y) : (k == 2 ? four.z : four.w); }

ivec2 bucket_of(int cell) { return ivec2(cell & (1 << bucket_bits) - 1, cell >> bucket_bits); }
