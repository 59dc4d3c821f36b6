// Whether a particle is a drop on its own: next to none are around it (splat/crowd.glsl). Wants common/ball.glsl.
bool is_alone(uint index)
{
    return shape[3u * index + 2u].w < 0.25;
}
