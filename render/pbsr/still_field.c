#include "render/pbsr/still_field.h"

#include "sim/surface/analytic.h"

#include <math.h>

static const double DEGREE = 3.14159265358979323846 / 180;

/* Radius of a torus's tube, as a fraction of the ring's radius. */
static const double TUBE = 1.0 / 3;

bool still_field(const PbsrLayer *said, const double box[3], LevelField *field, Error *error)
{
    const double low[3] = {-box[0] / 2, 0, -box[2] / 2}, high[3] = {box[0] / 2, box[1], box[2] / 2};
    const double centre[3] = {0, box[1] / 2, 0}, size = said->level;
    if (pbsr_of_file(said)) {
        if (!said->data)
            return error_set(error, "%s could not be read", said->file);
        return said->of > PBSR_SLICE_Z
                   ? error_set(error, "of a file a layer is a surface, volume or slice")
                   : level_volume(&said->data->volume, pbsr_interpolation(said), field, error);
    }
    switch (said->of) {
    case PBSR_SPHERE:
        *field = level_sphere(centre, size);
        break;
    case PBSR_TORUS:
        *field = level_torus(centre, size, size * TUBE);
        break;
    case PBSR_GYROID:
        *field = level_gyroid(low, high, size);
        break;
    default:
        *field = level_wave(low, high, size, 0.1 * box[1], 0.5 * fmax(box[0], box[2]));
    }
    return true;
}

/* Rotation about an axis by an angle: O. Rodrigues, 1840. */
void still_turn(const PbsrLayer *said, double turn[3][3])
{
    const double *a = said->axis, length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const double angle = length > 0 ? said->angle_deg * DEGREE : 0, by = length > 0 ? 1 / length : 0;
    const double n[3] = {a[0] * by, a[1] * by, a[2] * by}, c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            turn[i][k] = (1 - c) * n[i] * n[k] + (i == k ? c : 0);
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, m = (i + 2) % 3;
        turn[i][k] -= s * n[m];
        turn[k][i] += s * n[m];
    }
}

/* Converts a row for positions x in the box's frame to the layer's frame: place = turn (x - middle) +
   middle + position. */
static void move_row(const float row[4], const double turn[3][3], const double middle[3],
                     const double position[3], float out[4])
{
    double shift = (double)row[3];
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < 3; i++)
            sum += (double)row[i] * turn[i][k];
        out[k] = (float)sum;
        shift += (double)row[k] * (middle[k] + position[k]) - sum * middle[k];
    }
    out[3] = (float)shift;
}

SetSight still_sight(const PbsrLayer *said, const LevelField *field, const SetSight *sight)
{
    SetSight own = *sight;
    double turn[3][3], middle[3];
    still_turn(said, turn);
    for (int k = 0; k < 3; k++)
        middle[k] = (field->low[k] + field->high[k]) / 2;
    for (int r = 0; r < 3; r++)
        move_row(sight->row[r], turn, middle, said->position, own.row[r]);
    if (said->data) {
        own.low = said->data->low;
        own.scale = said->data->high > said->data->low ? 1 / (said->data->high - said->data->low) : 1;
    }
    return own;
}

bool still_leaves(const PbsrLayer *said, const double box[3])
{
    const double *at = said->position;
    const double reach = said->level * (said->of == PBSR_TORUS ? 1 + TUBE : 1);
    const bool ball = said->of == PBSR_SPHERE || said->of == PBSR_TORUS;
    return pbsr_still(said) &&
           (pbsr_of_file(said) || at[0] != 0 || at[1] != 0 || at[2] != 0 || said->angle_deg != 0 ||
            (ball && 2 * reach > fmin(box[0], fmin(box[1], box[2]))));
}
