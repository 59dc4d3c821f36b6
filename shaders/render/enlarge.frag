// Shows a picture of another resolution. Fewer pixels are enlarged: encoded colours, read and written unchanged. With FINE, more
// pixels are averaged in linear light: at twice the resolution the linear filter takes the mean of four.
#include "shaders/shared/bindings.h"
#ifdef FINE
#include "common/encoded.glsl"
#endif

layout(binding = ENLARGED_UNIT) uniform sampler2D picture;
layout(location = 0) in vec2 at;
layout(location = 0) out vec4 color;

void main()
{
    color = texture(picture, at);
#ifdef FINE
    color.rgb = encoded(color.rgb);
#endif
}
