// In builds with sanitizers alone: what they are to do differently.

/// AddressSanitizer of GCC 12 guesses what glibc 2.36 lays before a thread's dynamic TLS, and its leak
/// checker now and then crashes on the range ("Tracer caught signal 11"). Without that guess what only such
/// TLS points to would count as a leak: nothing is hidden.
extern "C" const char* __asan_default_options() { return "intercept_tls_get_addr=0"; }
