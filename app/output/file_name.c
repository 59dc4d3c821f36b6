#include "app/output/file_name.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

void file_name_new(char path[1024], const char *extension)
{
    char stamp[32];
    const time_t now = time(NULL);
    struct tm local;
    strftime(stamp, sizeof stamp, "%Y%m%d-%H%M%S", localtime_r(&now, &local));
    snprintf(path, 1024, "slosh-%s.%s", stamp, extension);
    for (int i = 2; access(path, F_OK) == 0 && i < 1000; i++)
        snprintf(path, 1024, "slosh-%s-%d.%s", stamp, i, extension);
}
