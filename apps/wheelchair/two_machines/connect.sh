#!/bin/sh
# Connects the two machines of the wheelchair and starts the components that need the other one; again after a restart of a host.
#   connect.sh ADDRESS_OF_JOYSTICK ADDRESS_OF_CHAIR
joystick=rtcloc://$1/JoystickComp hw=rtcloc://$2/HWComp control=rtcloc://$2/ControlComp
tandem=${TANDEM:-tandem}

# Only the newest value matters of each: one that waited while the network was down would be an old command.
$tandem rtm connect "$hw:joystickPos" "$joystick:joystickPos" -p subscription_type=new
$tandem rtm connect "$joystick:reference" "$control:reference" -p subscription_type=new
$tandem rtm connect "$joystick:chair" "$hw:chair"
$tandem rtm connect "$control:joystick" "$joystick:joystick"

# Their onStart asks the other machine, and has failed while nobody was connected.
for component in "$joystick" "$control"; do
    if $tandem rtm info "$component" --json | grep -q '"ERROR"'; then $tandem rtm reset "$component" || exit 1; fi
    $tandem rtm activate "$component" || exit 1
done
