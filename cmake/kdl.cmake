# orocos-kdl's own configuration gives a bare library name; wrap it once as an imported target with system includes.
find_package(orocos_kdl REQUIRED)
if(NOT TARGET circlepoint::kdl)
  find_library(CIRCLEPOINT_KDL_LIBRARY NAMES orocos-kdl REQUIRED)
  add_library(circlepoint::kdl INTERFACE IMPORTED)
  set_target_properties(circlepoint::kdl PROPERTIES
    INTERFACE_LINK_LIBRARIES "${CIRCLEPOINT_KDL_LIBRARY}"
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${orocos_kdl_INCLUDE_DIRS}")
endif()
