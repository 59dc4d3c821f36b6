// Neighbours of a particle, from the buckets of its cell and the cells around: nine rows of three cells, in two
// dimensions three rows. Places fill up from the first on, so an empty place ends a cell.
#include "sim/fragment/cells.glsl"
#include "sim/images.glsl"
uniform usampler2DArray buckets; // four particles per texel: index + 1; 0: none

void meet(int j); // defined by the pass: handles particle j (never the particle itself) at any distance
void meet_images(int j); // defined by the pass: handles j for the images, including the particle itself

// The images of the particle in the walls: bits of their numbers, and the particle's coordinates mirrored in the lower and the
// upper walls. A list of images would be in slow memory.
uint images = 0u;
vec3 unmirrored, mirrored_low, mirrored_high;

void images_make(vec3 x)
{
    int end = images_end(x);
    Image low, high;
    for (int walls = 1; walls < end; walls++) {
        Image image;
        images |= image_of(x, walls, image) ? 1u << walls : 0u;
    }
    image_of(x, 13, low); // all lower walls, all upper walls
    image_of(x, 26, high);
    unmirrored = x;
    mirrored_low = low.x;
    mirrored_high = high.x;
}

// The first of the images in the bits. Loops take the images in turn: for (uint left = images; left != 0u; left &= left - 1u)
Image first_image(uint left)
{
    int number = (floatBitsToInt(float(left & (~left + 1u))) >> 23) - 127; // GLSL 3.30 has no findLSB
    ivec3 place = ivec3(number) / ivec3(1, 3, 9), side = place - 3 * (place / 3);
    bvec3 upper = equal(side, ivec3(2));
    return Image(mix(mix(unmirrored, mirrored_low, equal(side, ivec3(1))), mirrored_high, upper), mix(vec3(1), vec3(-1), greaterThan(side, ivec3(0))));
}

// True if particle i at x is in the buckets.
bool meet_neighbours(int i, vec3 x)
{
    int middle = cell_index(cell_of(x));
    uint own = uint(i + 1);
    bool placed = false;
    images_make(x);
    for (int row = first_row; row < last_row; row++) {
        int first = middle + cell_index(ivec3(-1, row % 3 - 1, row / 3 - 1));
        for (int cell = first; cell < first + 3; cell++) {
            uint last = 1u;
            for (int layer = 0; layer < bucket_layers && last != 0u; layer++) {
                uvec4 four = texelFetch(buckets, ivec3(bucket_of(cell), layer), 0);
                last = four.w;
                for (int k = 0; k < 4; k++) {
                    uint entry = place_of(four, k);
                    if (entry == 0u)
                        break;
                    if (entry == own)
                        placed = true;
                    else
                        meet(int(entry) - 1);
                    if (images != 0u)
                        meet_images(int(entry) - 1);
                }
            }
        }
    }
    if (!placed && images != 0u)
        meet_images(i);
    return placed;
}
