// Enlarges a coarse picture to the screen: encoded colours, read and written unchanged.
#include "shaders/shared/bindings.h"

layout(binding = ENLARGED_UNIT) uniform sampler2D picture;
layout(location = 0) in vec2 at;
layout(location = 0) out vec4 color;

void main()
{
    color = texture(picture, at);
}
