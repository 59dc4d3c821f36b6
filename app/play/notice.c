#include "app/play/notice.h"

#include "sim/base/error.h"
#include "sim/base/stage.h"

#include <stdarg.h>
#include <stdio.h>

static const double NOTICE_MS = 4000;

static void show(Notice *notice, const char *words)
{
    snprintf(notice->words, sizeof notice->words, "%.300s", words);
    notice->until_ms = wall_ms() + NOTICE_MS;
    notice->fresh = true;
}

void notice_tell(Notice *notice, const char *format, ...)
{
    char words[sizeof(Error)];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(words, sizeof words, format, arguments);
    va_end(arguments);
    show(notice, words);
    if (!notice->quiet)
        fprintf(stderr, "%s\n", words);
}

void notice_error(Notice *notice, const char *message)
{
    show(notice, message);
    fprintf(stderr, "%s\n", message);
}

const char *notice_now(const Notice *notice)
{
    return wall_ms() < notice->until_ms ? notice->words : NULL;
}

bool notice_changed(Notice *notice)
{
    const bool stands = notice_now(notice) != NULL, changed = notice->fresh || stands != notice->stood;
    notice->fresh = false;
    notice->stood = stands;
    return changed;
}
