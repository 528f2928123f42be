#!/bin/sh
# Connects the two machines of the wheelchair and starts the components that need each other. Run it again after a host
# restart.
#   connect.sh ADDRESS_OF_JOYSTICK ADDRESS_OF_CHAIR
joystick=rtcloc://$1/JoystickComp hw=rtcloc://$2/HWComp control=rtcloc://$2/ControlComp
tandem=${TANDEM:-tandem}

# Transmits only the newest values, because a value that waited during a network failure is an outdated command.
"$tandem" rtm connect "$hw:joystickPos" "$joystick:joystickPos" -p subscription_type=new
"$tandem" rtm connect "$joystick:reference" "$control:reference" -p subscription_type=new
"$tandem" rtm connect "$joystick:chair" "$hw:chair"
"$tandem" rtm connect "$control:joystick" "$joystick:joystick"

# Their onStart calls the other machine, and failed without a connection.
for component in "$joystick" "$control"; do
    if "$tandem" rtm info "$component" --json | grep -q '"ERROR"'; then "$tandem" rtm reset "$component" || exit 1; fi
    "$tandem" rtm activate "$component" || exit 1
done
