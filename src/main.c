#include "config.h"

#include <stdio.h>

int main(void)
{
    fputs("isoloft: nothing is built into it yet\n", stderr);
    return 70;
}
