// A column of three numbers of scratch, by the place of its first.
vec3 column_of(uint at, uint i)
{
    return vec3(scratch[at + i], scratch[at + OWN_STRIDE + i], scratch[at + 2u * OWN_STRIDE + i]);
}

void column_set(uint at, uint i, vec3 value)
{
    for (uint k = 0u; k < 3u; k++)
        scratch[at + k * OWN_STRIDE + i] = value[k];
}

// The product with a symmetric matrix: xx yy zz, xy yz zx.
vec3 times(vec3 diagonal, vec3 mixed, vec3 v) { return diagonal * v + mixed * v.yzx + mixed.zxy * v.zxy; }
