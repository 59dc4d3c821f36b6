// The colour mask selects the place.
flat in uint number;
layout(location = 0) out uvec4 place;

void main() { place = uvec4(number); }
