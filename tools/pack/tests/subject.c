// What the tests pack: says what it was given and ends as it was told.
#include <stdio.h>
#include <stdlib.h>

static const char *const parts[] = {"arguments", "environment"};

int main(int count, char **arguments) {
    printf("%s:", parts[0]);
    for (int i = 0; i < count; i++) printf(" [%s]", arguments[i]);
    const char *value = getenv("PACK_TEST");
    printf("\n%s: %s\n", parts[1], value ? value : "none");
    return count > 1 ? atoi(arguments[1]) : 0;
}
