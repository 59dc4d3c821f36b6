// An arrow for each sample of a grid or a plane: the mean of the fluid around.
#include "common/mean.glsl"
#include "common/sample_grid.glsl"
#include "glyphs/glyphs_append.glsl"

void main()
{
    uint i = invocation();
    if (beyond_sample_grid(i))
        return;
    vec3 at = sample_grid_place(i);
    Mean mean = mean_at(at);
    if (mean.weight >= mean_least)
        append(at, mean.vector / mean.weight, shown_of(mean));
}
