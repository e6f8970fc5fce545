// Preloaded into a program, sets its system clock back by as many ns as the file $SET_BACK_CLOCK holds, at any time.
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

static const volatile int64_t* back_ns;

__attribute__((constructor)) static void open_file(void) {
  const char* name = getenv("SET_BACK_CLOCK");
  const int file = name ? open(name, O_RDONLY) : -1;
  if (file < 0) return;
  void* mapped = mmap(NULL, sizeof(int64_t), PROT_READ, MAP_SHARED, file, 0);
  if (mapped != MAP_FAILED) back_ns = mapped;
}

int clock_gettime(clockid_t clock, struct timespec* time) {
  const int result = (int)syscall(SYS_clock_gettime, clock, time);
  if (result != 0 || clock != CLOCK_REALTIME || !back_ns) return result;
  const int64_t ns = time->tv_sec * INT64_C(1000000000) + time->tv_nsec - *back_ns;
  time->tv_sec = ns / 1000000000;
  time->tv_nsec = ns % 1000000000;
  return 0;
}
