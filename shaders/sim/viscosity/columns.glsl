// The product with a symmetric matrix: xx yy zz, xy yz zx.
vec3 times(vec3 diagonal, vec3 mixed, vec3 v) { return diagonal * v + mixed * v.yzx + mixed.zxy * v.zxy; }
