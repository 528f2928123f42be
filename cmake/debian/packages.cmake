# SPDX-License-Identifier: Apache-2.0
# The packages. dpkg-shlibdeps finds the packages of libraries that programs are linked with. The other dependencies are named
# here, and our own packages, in the same version. The packages take their files in this order: a later one gets what the
# patterns of the earlier ones have left.

set(about "Tandem runs unmodified OPRoS components and unmodified OpenRTM-aist
RT-Components in one real-time application, joined through shared memory.
.
")

tandem_deb_package(libtandem-opros SECTION libs
  SUMMARY "component library of Tandem for OPRoS components"
  DESCRIPTION "${about}This package has the library that OPRoS components are linked with.")
tandem_deb_package(libtandem-rtm SECTION libs
  SUMMARY "component library of Tandem for RT-Components"
  DESCRIPTION "${about}This package has the libraries that RT-Components are linked with.")
tandem_deb_package(tandem-bench SECTION science
  SUMMARY "measures what messages cost on Tandem and on this machine"
  DESCRIPTION "${about}This package has the program tandem-bench, which measures latency and
throughput of Tandem, of the machine's own limits, and of other middleware."
  DEPENDS tandem-tools binutils)
tandem_deb_package(tandem-tools SECTION science
  SUMMARY "inspects, builds, runs and records components on Tandem"
  DESCRIPTION "${about}This package has the program tandem, the service tandem@.service, which
runs an application from a folder, and the wheelchair, a complete example."
  DEPENDS tandem-runtime
  RECOMMENDS gnuplot-nox bash-completion
  SUGGESTS tandem-opros-dev tandem-rtm-dev graphviz omniidl python3)
tandem_deb_package(tandem-runtime SECTION science
  SUMMARY "hosts for OPRoS components and RT-Components"
  DESCRIPTION "${about}This package has both hosts, both sides of the proxy, simulated
devices, the group tandem, whose members may use real-time priorities,
locked memory, gamepads and /dev/cpu_dma_latency, and the user tandem, as
which the service runs."
  DEPENDS libtandem-opros libtandem-rtm acl adduser
  SUGGESTS omniorb-nameserver)
tandem_deb_package(tandem-opros-dev NO_PROGRAMS SECTION libdevel
  SUMMARY "builds OPRoS components for Tandem"
  DESCRIPTION "${about}This package has the headers of the OPRoS component API and the CMake
package Tandem for them. `tandem opros build` needs it."
  DEPENDS libtandem-opros tandem-tools cmake g++ make pkgconf)
tandem_deb_package(tandem-rtm-dev NO_PROGRAMS SECTION libdevel
  SUMMARY "builds RT-Components for Tandem"
  DESCRIPTION "${about}This package has the headers of the OpenRTM-aist component API, the CMake
packages Tandem and OpenRTM, and rtm-config, rtm-skelwrapper and rtm-naming.
`tandem rtm build` needs it. It takes the place of the development package
of OpenRTM-aist."
  DEPENDS libtandem-rtm tandem-tools cmake g++ make pkgconf libomniorb4-dev omniidl omniorb-idl python3
  SUGGESTS omniorb-nameserver
  CONFLICTS openrtm-aist openrtm-aist-dev openrtm2-dev openrtm2-naming)
