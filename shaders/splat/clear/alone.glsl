// True if a particle is an isolated drop, with almost no neighbours (splat/crowd.glsl). Needs common/ball.glsl.
bool is_alone(uint index)
{
    return shape[3u * index + 2u].w < 0.25;
}
