#include "sim/surface/level_kind.h"

void level_parts(const LevelField *field, LevelParts *out)
{
    *out = (LevelParts){0};
    if (field->kind->parts)
        field->kind->parts(field, out);
    for (int k = 0; k < 8 && !field->kind->parts; k++)
        out->number[k] = (float)field->number[k];
}

void level_at(const LevelField *field, const double place[3], LevelSample *out)
{
    const LanePlace p = {lanes((float)place[0]), lanes((float)place[1]), lanes((float)place[2])};
    LaneSample s;
    level_lanes(field, &p, &s);
    *out = (LevelSample){s.value[0], {s.x[0], s.y[0], s.z[0]}, s.bend[0]};
}
