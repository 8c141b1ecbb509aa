# Tells `find_package(Burnish VERSION)` which version lies beside this file. Before 1.0, a minor
# version may break things, so only versions with the same first two numbers are compatible.

set(PACKAGE_VERSION 0.1.0)
string(REGEX MATCH "^[0-9]+\\.[0-9]+" _burnish_series "${PACKAGE_VERSION}")
string(REGEX MATCH "^[0-9]+\\.[0-9]+" _burnish_wanted "${PACKAGE_FIND_VERSION}.0")
if(PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION)
    set(PACKAGE_VERSION_COMPATIBLE FALSE)
elseif(_burnish_wanted VERSION_EQUAL _burnish_series)
    set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
endif()
