#include "app/play/ask.h"

#include <stdio.h>

static bool adds_up(AskKind kind)
{
    return kind == ASK_TURN || kind == ASK_PAN || kind == ASK_ZOOM || kind == ASK_STEER ||
           kind == ASK_TOUCH || kind == ASK_GRAVITY;
}

void ask_add(AskQueue *queue, const Ask *ask)
{
    Ask *last = &queue->asks[(queue->first + queue->count + ASKS_MAX - 1) % ASKS_MAX];
    if (queue->count > 0 && last->kind == ask->kind && adds_up(ask->kind)) {
        for (int k = 0; k < 3; k++)
            last->amount[k] += ask->amount[k];
        return;
    }
    if (queue->count < ASKS_MAX)
        queue->asks[(queue->first + queue->count++) % ASKS_MAX] = *ask;
    else
        queue->lost++;
}

int ask_lost(AskQueue *queue)
{
    const int lost = queue->lost;
    queue->lost = 0;
    return lost;
}

void ask_command(AskQueue *queue, PlayCommand command)
{
    ask_add(queue, &(Ask){.kind = ASK_COMMAND, .command = command});
}

void ask_settings(AskQueue *queue, const ViewSetting *settings, int count)
{
    for (int i = 0; i < count; i++) {
        Ask ask = {.kind = ASK_SETTING};
        snprintf(ask.text, sizeof ask.text, "%s", settings[i].text);
        ask_add(queue, &ask);
    }
}

bool ask_next(AskQueue *queue, Ask *ask)
{
    if (queue->count == 0)
        return false;
    *ask = queue->asks[queue->first];
    queue->first = (queue->first + 1) % ASKS_MAX;
    queue->count--;
    return true;
}
