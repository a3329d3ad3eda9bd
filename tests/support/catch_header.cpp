// Empty: gives the precompiled Catch2 header, which all test programs share, a file to be compiled for.
