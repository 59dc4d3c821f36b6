// What culling keeps, of `chunks` of 32 particles and of both lists: numbers, turned by prefix sums into the numbers before,
// then the total, then words of bits.
#define KEPT_NUMBER(k) ((k) * chunks)
#define KEPT_BITS(k)   (((k) + 2u) * chunks + 1u)
