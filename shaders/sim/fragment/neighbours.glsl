// Neighbours of a particle, from the buckets of its cell and the cells around: nine rows of three cells, in two
// dimensions three rows. Places fill up from the first on, so an empty place ends a cell.
#include "sim/fragment/cells.glsl"
#include "sim/images.glsl"
uniform usampler2DArray buckets; // four particles per texel: index + 1; 0: none

void meet(int j); // defined by the pass: handles particle j (never the particle itself) at any distance
void meet_images(int j); // defined by the pass: handles j for the images, including the particle itself

// The images of the particle in the walls.
Image images[26];
int image_count = 0;

void images_make(vec3 x)
{
    int end = images_end(x);
    for (int walls = 1; walls < end; walls++) {
        Image image;
        if (image_of(x, walls, image))
            images[image_count++] = image;
    }
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
                    if (image_count > 0)
                        meet_images(int(entry) - 1);
                }
            }
        }
    }
    if (!placed && image_count > 0)
        meet_images(i);
    return placed;
}
