#include "app/device/sensor_clock.h"

#include <math.h>

double sensor_clock_late(SensorClock *clock, double time, uint32_t ticks, int bits, double tick)
{
    const uint32_t mask = bits < 32 ? (1u << bits) - 1 : UINT32_MAX;
    const uint32_t since = (ticks - clock->ticks) & mask;
    const double came = time - clock->time, over = ldexp(tick, bits);
    const bool known = clock->runs && since && came >= 0 && came < over / 2;
    clock->own += known ? since * tick : came;
    clock->ahead += SENSOR_CLOCK_DRIFT * came;
    clock->ticks = ticks;
    clock->time = time;
    const double late = time - clock->own - clock->ahead;
    if (clock->runs && late > 0 && late <= SENSOR_CLOCK_LATEST)
        return late;
    clock->runs = true;
    clock->ahead = time - clock->own;
    return 0;
}
