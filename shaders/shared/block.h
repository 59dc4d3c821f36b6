/* Macros for blocks that C and GLSL share. A file NAME_block.h in shaders/ is included by the C file that
   fills the block and by the shaders that read the block, both as "shaders/shared/NAME_block.h".

   In C, a block is a struct with the block's name, whose members have std140 offsets. Types that C cannot
   express are excluded: array elements are vec4, mat4 or structs of 16 bytes; no mat3, no bool.
   tests/gl/test_blocks.c compares each member with the driver's offset. */
#ifndef SLOSH_BLOCK_H
#define SLOSH_BLOCK_H

#ifdef __STDC_VERSION__ /* C */

#define BLOCK_ALIGNED(bytes) __attribute__((aligned(bytes)))
typedef unsigned uint;
typedef float vec2[2] BLOCK_ALIGNED(8), vec3[3] BLOCK_ALIGNED(16), vec4[4] BLOCK_ALIGNED(16);
typedef int ivec2[2] BLOCK_ALIGNED(8), ivec3[3] BLOCK_ALIGNED(16), ivec4[4] BLOCK_ALIGNED(16);
typedef uint uvec2[2] BLOCK_ALIGNED(8), uvec3[3] BLOCK_ALIGNED(16), uvec4[4] BLOCK_ALIGNED(16);
typedef double dvec3[3] BLOCK_ALIGNED(32);
typedef float mat4[16] BLOCK_ALIGNED(16); /* column-major */

#define BLOCK_STRUCT(name)          typedef struct BLOCK_ALIGNED(16) name
#define UNIFORM_BLOCK(name, number) BLOCK_STRUCT(name)
#define STORAGE_BLOCK(name, number) BLOCK_STRUCT(name)
#define BLOCK_END(name)             name

#else /* GLSL */

#define BLOCK_STRUCT(name)          struct name
#define UNIFORM_BLOCK(name, number) layout(std140, binding = number) uniform name
#define STORAGE_BLOCK(name, number) layout(std430, binding = number) buffer name
#define BLOCK_END(name)

#endif

#endif
