// The cell of x, as in sim/cpu/grid.c; clamped, so that a non-finite position does no harm before the report. Cell c
// is texel (c mod width, c / width) of each layer of the buckets, with width 2^bucket_bits.
ivec3 cell_of(vec3 x)
{
    ivec3 first = first_cell + 1, last = first_cell + grid_size - 2;
    return clamp(ivec3(floor(x * inverse_support)), first, last) - first + 1;
}

int cell_index(ivec3 at) { return (at.z * grid_size.y + at.y) * grid_size.x + at.x; }

// The k-th of four places. NVIDIA's compiler (580) let empty places pass a loop `k < 4 && four[k] != 0u`: so no
// component by index, and the test is inside the loop.
uint place_of(uvec4 four, int k) { return k < 2 ? (k == 0 ? four.x : four.y) : (k == 2 ? four.z : four.w); }

ivec2 bucket_of(int cell) { return ivec2(cell & (1 << bucket_bits) - 1, cell >> bucket_bits); }
