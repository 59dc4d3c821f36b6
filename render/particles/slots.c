#include "render/particles/slots.h"

void slots_create(Slots *slots)
{
    *slots = (Slots){.written = SLOT_NONE, .newest = SLOT_NONE, .drawn = SLOT_NONE, .in_flight = SLOT_NONE};
    pthread_mutex_init(&slots->lock, NULL);
}

void slots_destroy(Slots *slots)
{
    pthread_mutex_destroy(&slots->lock);
}

int slots_write_begin(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    int slot = 0;
    while (slot == slots->newest || slot == slots->drawn || slot == slots->in_flight)
        slot++;
    slots->written = slot;
    pthread_mutex_unlock(&slots->lock);
    return slot;
}

void slots_write_end(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    slots->newest = slots->written;
    slots->written = SLOT_NONE;
    pthread_mutex_unlock(&slots->lock);
}

bool slots_fresh(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    const bool fresh = slots->newest != SLOT_NONE;
    pthread_mutex_unlock(&slots->lock);
    return fresh;
}

int slots_draw(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    if (slots->newest != SLOT_NONE) {
        slots->in_flight = slots->drawn;
        slots->drawn = slots->newest;
        slots->newest = SLOT_NONE;
    }
    const int drawn = slots->drawn;
    pthread_mutex_unlock(&slots->lock);
    return drawn;
}

void slots_landed(Slots *slots)
{
    pthread_mutex_lock(&slots->lock);
    slots->in_flight = SLOT_NONE;
    pthread_mutex_unlock(&slots->lock);
}
